// surface.frag - linear light: ambient, Lambert, a Blinn-Phong highlight; or one flat colour.
//
// LIGHTS       how many lights are added at once (0: none)
// TEXTURED     the base colour has a texture
// CUT          alphaMode MASK: cut below u_cutoff in every pass
// FLAT         one colour instead of shading
// GN_MASKED    lights of a pass have masks in a texture (gnomon_gles.h)
// GN_DEPTH_COLOR  the depth that masks carry, in place of u_flat (gnomon_gles.h)
// FROM_BEHIND  the back of the face is seen
// PRECISION    highp where there is one
//
// Falloff and cones are those of KHR_lights_punctual.
precision PRECISION float;
uniform vec4 u_base;
uniform vec4 u_flat;
#if FLAT && defined(GN_MASKED)
uniform vec4 u_channels;   // of the mask: that which u_flat is under
#endif
uniform vec3 u_ambient;    // a share of the base colour
uniform float u_emits;
uniform vec3 u_emissive;
uniform float u_cutoff;
uniform float u_shininess;
uniform vec3 u_specular;
uniform float u_metallic;
uniform float u_two_sided;
#if TEXTURED
uniform sampler2D u_texture;
#endif
#if LIGHTS
uniform vec4 u_light_position[LIGHTS]; // from the eye; w = 0: a direction towards the light
uniform vec3 u_light_color[LIGHTS];
uniform vec4 u_light_axis[LIGHTS];     // of the cone, from the light outward; w: 1 / range, 0 without
uniform vec2 u_light_cone[LIGHTS];     // scale and offset of the cosine; 0, 1 without a cone
#endif
varying vec3 v_position;
varying mediump vec3 v_normal;
varying vec2 v_uv;
varying lowp vec4 v_color;

void main()
{
    vec4 base = u_base * v_color;
#if TEXTURED
    vec4 texel = texture2D(u_texture, v_uv);
    base *= vec4(pow(texel.rgb, vec3(2.2)), texel.a);
#endif
#if CUT
    if (base.a < u_cutoff)
        discard;
#endif
#if FLAT
    gl_FragColor = u_flat;
#ifdef GN_DEPTH_COLOR
    gl_FragColor = gn_mask_depth_color();
#endif
#ifdef GN_MASKED
    gl_FragColor *= dot(gn_mask(), u_channels);
#endif
#else
    vec3 color = u_ambient * base.rgb + u_emits * u_emissive;
#if LIGHTS
    vec4 mask = gn_mask();
    vec3 n = normalize(v_normal);
    vec3 v = normalize(-v_position);
    if (u_two_sided > 0.5 && FROM_BEHIND)
        n = -n;
    for (int i = 0; i < LIGHTS; i++) {
        vec3 to_light = u_light_position[i].xyz - v_position * u_light_position[i].w;
        float distance = length(to_light);
        float reach = distance * u_light_axis[i].w; // of the range; its fourth power only where it cannot overflow
        vec3 l = to_light / max(distance, 0.0001);
        float facing = dot(n, l);
        float falloff = 1.0;
        if (u_light_position[i].w > 0.5)
            falloff = reach < 1.0 ? (1.0 - reach * reach * reach * reach) / max(distance * distance, 0.0001) : 0.0;
        float cone = clamp(dot(-l, u_light_axis[i].xyz) * u_light_cone[i].x + u_light_cone[i].y, 0.0, 1.0);
        float shine = pow(max(dot(n, normalize(l + v)), 0.0), u_shininess) * (u_shininess + 8.0) * 0.125;
        vec3 reflected = base.rgb * (1.0 - u_metallic) + mix(vec3(0.04), base.rgb, u_metallic) * u_specular * shine;
        color += mask[i] * step(0.0, facing) * facing * falloff * cone * cone * u_light_color[i] * reflected;
    }
#endif
    gl_FragColor = vec4(color, base.a);
#endif
}
