// surface.vert - an object's surface. Its position is by the library's statement (gnomon_gles.h).
attribute highp vec3 a_position; // less the mesh's centre
attribute highp vec3 a_normal;
attribute highp vec2 a_uv;
attribute lowp vec4 a_color;
uniform highp mat4 u_clip;
uniform highp mat4 u_world;   // to world space from the eye
uniform highp mat3 u_normal;
varying highp vec3 v_position;
varying mediump vec3 v_normal;
varying highp vec2 v_uv;
varying lowp vec4 v_color;

void main()
{
    gl_Position = gn_position(u_clip, a_position);
    gn_mask_place(gl_Position);
    v_position = (u_world * vec4(a_position, 1.0)).xyz;
    v_normal = normalize(u_normal * a_normal); // of any scale; fragments may be half floats
    v_uv = a_uv;
    v_color = a_color;
}
