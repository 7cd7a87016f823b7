// flat.frag - one colour, or one a side.
//
// COUNTED no colour: as counted.frag
// FACED   u_color for fronts, u_back for backs
// SIDED   one side of triangles only: u_side 1 for fronts, -1 for backs. Read in main() alone: some drivers break
//         gl_FrontFacing elsewhere
#ifndef COUNTED
uniform mediump vec4 u_color;
#endif
#ifdef FACED
uniform mediump vec4 u_back;
#endif
#ifdef SIDED
uniform mediump float u_side;
#endif

void main()
{
#ifdef SIDED
    if ((gl_FrontFacing ? 1.0 : -1.0) * u_side < 0.0)
        discard;
#endif
#ifdef COUNTED
    gl_FragColor = vec4(0.0);
#elif defined(FACED)
    gl_FragColor = gl_FrontFacing ? u_color : u_back;
#else
    gl_FragColor = u_color;
#endif
}
