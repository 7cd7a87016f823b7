// agree.frag - nothing where a small mask is contested: between its texels it is neither 0 nor 1, or one of them is on an
// edge of depth. The texture is filtered bilinearly, so that one look sees the four around.
//
// u_weights  the light's channel
// u_level    1: what is lit is drawn; 0: what is not
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
    mediump vec4 mask = texture2D(u_texture, v_at);

    if (mask.b < 0.998 || abs(dot(mask, u_weights) - u_level) > 0.002)
        discard;
    gl_FragColor = vec4(0.0);
}
