// A vertex of a thing of the place: a SolidVertex, and the CoarseVertex into which it fades. To be
// included by vertex shaders after shader_interface.h and instance.glsl. Out: FadedVertex, in the
// prototype's frame.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normalAndRoughness;
layout(location = 2) in vec4 albedoAndSky;  // of rock: lightness, turf, pink crust; occlusion
layout(location = kChosenAttribute) in uint chosen;
layout(location = kCoarseAttribute) in vec3 coarsePosition;
layout(location = kCoarseAttribute + 1) in vec4 coarseNormal;
layout(location = kCoarseAttribute + 2) in vec4 coarseAlbedoAndSky;
struct FadedVertex {
    vec3 position, normal;
    vec4 albedoAndSky;
};
FadedVertex fadedVertex() {
    float faded = fadedOf(chosen);
    return FadedVertex(mix(position, coarsePosition, faded), mix(normalAndRoughness.xyz, coarseNormal.xyz, faded),
                       mix(albedoAndSky, coarseAlbedoAndSky, faded));
}
