// quad.vert - a quad over the target, with where it is in a texture of the target's size.
attribute highp vec4 a_position;
varying highp vec2 v_at;

void main()
{
    gl_Position = a_position;
    v_at = 0.5 * a_position.xy + 0.5;
}
