/* gni_features.h - what a build may do without, so that what is left fits a small board: `make FEATURES="..."` names what
 * it keeps, and the Makefile says by files what goes with the rest, and which feature stands on which.
 *
 *     culling   the method stencil, which draws what a scene requires; cameras and targets whose volumes must end; lights
 *               made soft; errors of casters and planes of meshes in what is told. Without: zfail and zpass, in the whole target
 *     batches   more layers than a stencil counts. Without: the plan warns (GN_WARN_OVERFLOW) where it does not know that
 *               they fit
 *     fallback  stencils of one side or without wrapping; counts without a stencil; masks in textures, and small ones
 *     refine    small masks refined
 *     cache     shadows and masks that stay from frame to frame
 *     welding   gn_mesh_desc.weld_angle
 *     clusters  facing in floats, by a tree. Without: triangle by triangle in double, by which the bits are the same
 *     solids    proofs that a closed part does not pass through itself, and that a light is outside it. Without: only parts
 *               that a point sees all of are solid, and each triangle casts of others, and of those whose box a light is
 *               in; objects that their matrix flattens are refused
 *     proofs    capabilities proven by drawing; gn_gles_desc.hide; gn_gles_draw_volumes(). Without: capabilities are those
 *               of a text that another build has saved of the same driver and target (`gnomon probe --save`)
 *     messages  sentences: of errors, and why a plan has its method. Without: gn_message() says that they are not there
 *     selector  gn_select.h, rules and knowledge, also as text; gn_plan.traffic
 *     text      explanations of plans, and their JSON
 *
 * What a build lacks is refused, with the feature's name where it has messages. The code asks `GNI_HAS_...` where it calls
 * what may not be there: a constant, so that a compiler that optimises at all drops the rest; at
 * -O0 small builds may not link. */
#ifndef GNI_FEATURES_H
#define GNI_FEATURES_H
#include "gnomon.h"

#ifdef GNI_WITHOUT_culling
#define GNI_HAS_CULLING 0
#else
#define GNI_HAS_CULLING 1
#endif
#ifdef GNI_WITHOUT_batches
#define GNI_HAS_BATCHES 0
#else
#define GNI_HAS_BATCHES 1
#endif
#ifdef GNI_WITHOUT_fallback
#define GNI_HAS_FALLBACK 0
#else
#define GNI_HAS_FALLBACK 1
#endif
#ifdef GNI_WITHOUT_refine
#define GNI_HAS_REFINE 0
#else
#define GNI_HAS_REFINE 1
#endif
#ifdef GNI_WITHOUT_cache
#define GNI_HAS_CACHE 0
#else
#define GNI_HAS_CACHE 1
#endif
#ifdef GNI_WITHOUT_welding
#define GNI_HAS_WELDING 0
#else
#define GNI_HAS_WELDING 1
#endif
#ifdef GNI_WITHOUT_clusters
#define GNI_HAS_CLUSTERS 0
#else
#define GNI_HAS_CLUSTERS 1
#endif
#ifdef GNI_WITHOUT_solids
#define GNI_HAS_SOLIDS 0
#else
#define GNI_HAS_SOLIDS 1
#endif
#ifdef GNI_WITHOUT_messages
#define GNI_HAS_MESSAGES   0
#define GNI_SENTENCE(text) ""
/* Numbers are looked at by the compiler alone. */
#define gn_fail(context, result, ...) (0 ? (gn_fail)((context), (result), __VA_ARGS__) : (result))
#else
#define GNI_HAS_MESSAGES   1
#define GNI_SENTENCE(text) text
#endif
#ifdef GNI_WITHOUT_selector
#define GNI_HAS_SELECTOR 0
#else
#define GNI_HAS_SELECTOR 1
#endif
#ifdef GNI_WITHOUT_proofs
#define GNI_HAS_PROOFS 0
#else
#define GNI_HAS_PROOFS 1
#endif
#endif
