// mantissa.frag - how many bits of mantissa the arithmetic keeps, in 255ths: 1 + 2^-n is told from 1 while n is not more.
//
// u_ones  1, 1: two uniforms in one, so that no compiler can cancel them
#ifdef HIGHP
precision highp float;
#endif
uniform vec2 u_ones;

void main()
{
    float bits = 0.0, step = 1.0;

    for (int i = 0; i < 24; i++) {
        step *= 0.5;
        if (u_ones.x + step - u_ones.y > 0.0)
            bits += 1.0;
    }
    gl_FragColor = vec4(bits / 255.0);
}
