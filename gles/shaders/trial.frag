// trial.frag - what a fragment shader knows. How many bits of mantissa its arithmetic keeps, in 255ths: 1 + 2^-n is told
// from 1 while n is not more; red for mediump, green for highp. And in blue, full where it is told of a front face.
//
// u_ones  1, 1: two uniforms in one, so that no compiler can cancel them; u_high_ones the same
// HIGHP   there is highp
// FACING  there is gl_FrontFacing. Read in main() alone: some drivers break it elsewhere
uniform mediump vec2 u_ones;
#ifdef HIGHP
uniform highp vec2 u_high_ones;
#endif

void main()
{
    mediump float bits = 0.0, step = 1.0;

    for (int i = 0; i < 24; i++) {
        step *= 0.5;
        if (u_ones.x + step - u_ones.y > 0.0)
            bits += 1.0;
    }
    gl_FragColor = vec4(bits / 255.0, 0.0, 0.0, 1.0);
#ifdef HIGHP
    highp float high_step = 1.0;

    bits = 0.0;
    for (int i = 0; i < 24; i++) {
        high_step *= 0.5;
        if (u_high_ones.x + high_step - u_high_ones.y > 0.0)
            bits += 1.0;
    }
    gl_FragColor.g = bits / 255.0;
#endif
#ifdef FACING
    gl_FragColor.b = gl_FrontFacing ? 1.0 : 0.0;
#endif
}
