// resolve.frag - black where a count says shadow; where it says lit, nothing.
//
// u_weights  times the count's channels, in levels: their sum is u_level where a pixel is lit. Whole numbers up to 255:
//            half floats have them
#if defined(GL_FRAGMENT_PRECISION_HIGH) && !defined(GN_MEDIUMP)
varying highp vec2 v_at;
#else
varying mediump vec2 v_at;
#endif
uniform mediump sampler2D u_texture;
uniform mediump vec4 u_weights;
uniform mediump float u_level;

void main()
{
    if (abs(dot(texture2D(u_texture, v_at), u_weights) - u_level) < 0.5)
        discard;
    gl_FragColor = vec4(0.0);
}
