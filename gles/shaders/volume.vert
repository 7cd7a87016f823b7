// volume.vert - places the vertices of shadow volumes: near ones where the caster is, far ones away from the light.
//
// a_position  xyz in object space less the mesh's centre; w = 1 near, w = 0 far (McGuire 2003)
// u_near      the object's matrix to clip space
// u_far       the same after moving a point away from the light onto the end plane, at infinity mostly (core/extrude.c)
//
// A near vertex goes through gn_position(), the very statement of the host's passes: a last-bit difference would make
// caps fight the depth buffer. `invariant` is no help here: drivers ignore it or reject it.
attribute highp vec4 a_position;
uniform highp mat4 u_near;
uniform highp mat4 u_far;

void main()
{
    if (a_position.w > 0.5)
        gl_Position = gn_position(u_near, a_position.xyz);
    else
        gl_Position = u_far * vec4(a_position.xyz, 1.0);
}
