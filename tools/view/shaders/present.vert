attribute vec2 a_position;
varying vec2 v_uv;
varying vec2 v_mark_uv; // marks have row 0 on top

void main()
{
    v_uv = 0.5 * a_position + 0.5;
    v_mark_uv = vec2(0.5, -0.5) * a_position + 0.5;
    gl_Position = vec4(a_position, 0.0, 1.0);
}
