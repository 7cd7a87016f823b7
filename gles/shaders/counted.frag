// counted.frag - no colour is written. No uniform either: drivers keep a copy of all that a fragment shader reads for each draw
// between which it changes.
void main()
{
    gl_FragColor = vec4(0.0);
}
