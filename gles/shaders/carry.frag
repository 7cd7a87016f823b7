// carry.frag - a mask texture that is lit all over, with the depth that another carries.
#if defined(GL_FRAGMENT_PRECISION_HIGH) && !defined(GN_MEDIUMP)
varying highp vec2 v_at;
#else
varying mediump vec2 v_at;
#endif
uniform mediump sampler2D u_texture;

void main()
{
    gl_FragColor = vec4(1.0, 1.0, texture2D(u_texture, v_at).ba);
}
