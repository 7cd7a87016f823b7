// flat.frag - one colour; while volumes are counted no colour is written.
//
// SIDED   one side of triangles only: u_side 1 for fronts, -1 for backs. Read in main() alone: some drivers break
//         gl_FrontFacing elsewhere
uniform mediump vec4 u_color;
#ifdef SIDED
uniform mediump float u_side;
#endif

void main()
{
#ifdef SIDED
    if ((gl_FrontFacing ? 1.0 : -1.0) * u_side < 0.0)
        discard;
#endif
    gl_FragColor = u_color;
}
