precision mediump float;
uniform sampler2D u_font;
#ifdef GL_FRAGMENT_PRECISION_HIGH
varying highp vec2 v_uv;
#else
varying mediump vec2 v_uv;
#endif
varying mediump vec4 v_color;

void main()
{
    gl_FragColor = vec4(v_color.rgb, v_color.a * texture2D(u_font, v_uv).a);
}
