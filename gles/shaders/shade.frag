// shade.frag - what the shadows of a mask texture leave of a frame, to be multiplied with it.
//
// u_unused  1 in channels that are no light's
// u_dimmed  what one shadow leaves
#if defined(GL_FRAGMENT_PRECISION_HIGH) && !defined(GN_MEDIUMP)
varying highp vec2 v_at;
#else
varying mediump vec2 v_at;
#endif
uniform mediump sampler2D u_texture;
uniform mediump vec4 u_unused;
uniform mediump float u_dimmed;

void main()
{
    mediump vec4 left = mix(vec4(u_dimmed), vec4(1.0), max(texture2D(u_texture, v_at), u_unused));

    gl_FragColor = vec4(left.r * left.g * left.b * left.a);
}
