// edges.frag - a mask texture that is lit all over, and in blue 0 where the depth that another carries is cut through or
// bent. Carried depth is linear on the image of a plane: there what is on either side of a texel is, on average, its own.
// Also of half floats.
#if defined(GL_FRAGMENT_PRECISION_HIGH) && !defined(GN_MEDIUMP)
#define PLACE highp
#else
#define PLACE mediump
#endif
varying PLACE vec2 v_at, v_left, v_right, v_below, v_above;
uniform PLACE sampler2D u_texture;

PLACE float depth(PLACE vec4 texel)
{
    return texel.b + texel.a / 255.0;
}

void main()
{
    PLACE float at = depth(texture2D(u_texture, v_at));
    PLACE float across = depth(texture2D(u_texture, v_left)) + depth(texture2D(u_texture, v_right));
    PLACE float along = depth(texture2D(u_texture, v_below)) + depth(texture2D(u_texture, v_above));

    PLACE float bend = max(abs(across - 2.0 * at), abs(along - 2.0 * at));

    gl_FragColor = vec4(1.0, 1.0, bend < 0.02 * at + 0.00006 ? 1.0 : 0.0, 1.0);
}
