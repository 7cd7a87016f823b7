// line.frag - one colour.
uniform lowp vec4 u_flat;

void main()
{
    gl_FragColor = u_flat;
}
