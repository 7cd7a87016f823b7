// A frame, linear, as screens take it: sRGB; of two, each on its side; and over it what is different from the truth.
#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif
uniform sampler2D u_left;
uniform sampler2D u_right;
uniform sampler2D u_marks;
uniform float u_split;
uniform float u_marked;
varying vec2 v_uv;
varying vec2 v_mark_uv;

void main()
{
    vec3 linear = v_uv.x < u_split ? texture2D(u_left, v_uv).rgb : texture2D(u_right, v_uv).rgb;
    vec3 encoded = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
    vec4 mark = u_marked * step(v_uv.x, u_split) * texture2D(u_marks, v_mark_uv); // of the left side

    gl_FragColor = vec4(mix(encoded, mark.rgb, mark.a), 1.0);
}
