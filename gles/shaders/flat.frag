// flat.frag - one colour; while volumes are counted no colour is written.
uniform mediump vec4 u_color;

void main()
{
    gl_FragColor = u_color;
}
