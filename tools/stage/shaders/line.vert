// line.vert - silhouette edges, at the very place of the surface's vertices.
attribute highp vec3 a_position;
uniform highp mat4 u_clip;

void main()
{
    gl_Position = gn_position(u_clip, a_position);
}
