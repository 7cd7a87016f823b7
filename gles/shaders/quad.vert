// quad.vert - a quad over the target, with where it is in a texture of the target's size.
//
// CROSS  and where its neighbours are: half floats could not tell (DESIGN.md, decision 12)
attribute highp vec4 a_position;
varying highp vec2 v_at;
#ifdef CROSS
uniform highp vec2 u_step; // from a texel to the next
varying highp vec2 v_left, v_right, v_below, v_above;
#endif

void main()
{
    gl_Position = a_position;
    v_at = 0.5 * a_position.xy + 0.5;
#ifdef CROSS
    v_left = v_at - vec2(u_step.x, 0.0);
    v_right = v_at + vec2(u_step.x, 0.0);
    v_below = v_at - vec2(0.0, u_step.y);
    v_above = v_at + vec2(0.0, u_step.y);
#endif
}
