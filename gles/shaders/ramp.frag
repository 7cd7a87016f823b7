// ramp.frag - a step brighter from pixel to pixel, row by row, 16 in each: every level that a channel of 8 bits has.
//
// u_origin  the cell's lower left pixel
// u_levels  greatest level, 1 / greatest level
uniform mediump vec2 u_origin;
uniform mediump vec2 u_levels;

void main()
{
    mediump vec2 at = floor(gl_FragCoord.xy - u_origin);

    gl_FragColor = vec4(min(at.x + 16.0 * at.y, u_levels.x) * u_levels.y);
}
