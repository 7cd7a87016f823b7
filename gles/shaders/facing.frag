// facing.frag - red where a front face is seen, green where a back face is. Read in main() alone: some drivers break it
// elsewhere.
void main()
{
    gl_FragColor = gl_FrontFacing ? vec4(1.0, 0.0, 0.0, 1.0) : vec4(0.0, 1.0, 0.0, 1.0);
}
