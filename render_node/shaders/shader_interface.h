// SPDX-License-Identifier: Apache-2.0
// The constants that C++ and GLSL share: bindings of uniform blocks, shader storage and textures,
// locations of uniforms, and sizes. OpenGL guarantees eight storage blocks in a stage: blocks that
// are never bound at the same time may share a number.
#ifndef AQUARAMA_SHADER_INTERFACE_H
#define AQUARAMA_SHADER_INTERFACE_H
#ifdef __cplusplus
#include <cstdint>
#define AQUARAMA_CONSTANT inline constexpr
namespace aquarama::shaders {
using uint = std::uint32_t;
#else
#define AQUARAMA_CONSTANT const
#endif

// Uniform blocks.
// Bindings, std140: FrameUniforms of frame_uniforms.h, SeaNow of sea_now.glsl, DrawnLayers of
// drawn_layers.glsl.
AQUARAMA_CONSTANT int kFrameBlock = 0;
AQUARAMA_CONSTANT int kSeaBlock = 1;
AQUARAMA_CONSTANT int kDrawnLayersBlock = 2;

// Shader storage of the kernels that sort fish.
AQUARAMA_CONSTANT int kSchoolStorage = 0;
AQUARAMA_CONSTANT int kBeforeStorage = 1;
AQUARAMA_CONSTANT int kAfterStorage = 2;
AQUARAMA_CONSTANT int kTraitsStorage = 3;
AQUARAMA_CONSTANT int kCastStorage = 4;
AQUARAMA_CONSTANT int kChoicesStorage = 5;
AQUARAMA_CONSTANT int kPlanStorage = 6;
AQUARAMA_CONSTANT int kCountsStorage = 7;

// Of the kernel that makes surfaces, beside kSchoolStorage, kCastStorage and kPlanStorage.
AQUARAMA_CONSTANT int kFirstEntriesStorage = 2;
AQUARAMA_CONSTANT int kEntriesStorage = 3;
AQUARAMA_CONSTANT int kSurfaceStorage = 5;
AQUARAMA_CONSTANT int kParentsStorage = 7;

// Of the place.
AQUARAMA_CONSTANT int kInstancesStorage = 8;
AQUARAMA_CONSTANT int kPrototypesStorage = 9;
AQUARAMA_CONSTANT int kCommandsStorage = 10;
AQUARAMA_CONSTANT int kChosenStorage = 11;
AQUARAMA_CONSTANT int kWakeStorage = 12;
AQUARAMA_CONSTANT int kGroupsStorage = 13;
AQUARAMA_CONSTANT int kSeenGroupsStorage = 14;
// Of sand, beside kCommandsStorage; kGroupsStorage has balls about its patches.
AQUARAMA_CONSTANT int kPatchLevelsStorage = 9;
AQUARAMA_CONSTANT int kFadedStorage = 11;

// Of the colours of a skin.
AQUARAMA_CONSTANT int kSkinPlacesStorage = 0;
AQUARAMA_CONSTANT int kSkinColoursStorage = 1;

// Of food and of text.
AQUARAMA_CONSTANT int kSpecksStorage = 0;
AQUARAMA_CONSTANT int kGlyphsStorage = 0;

// Texture units of the light and the place.
AQUARAMA_CONSTANT int kDirectTableUnit = 8;
AQUARAMA_CONSTANT int kInscatterTableUnit = 9;
AQUARAMA_CONSTANT int kOpenWaterTableUnit = 10;
AQUARAMA_CONSTANT int kCausticLayersUnit = 11;
AQUARAMA_CONSTANT int kShaftMapUnit = 12;
AQUARAMA_CONSTANT int kWaveTileUnit = 13;
AQUARAMA_CONSTANT int kDetailTileUnit = 14;
AQUARAMA_CONSTANT int kFloorShadeUnit = 15;
AQUARAMA_CONSTANT int kFloorRockUnit = 16;
AQUARAMA_CONSTANT int kFishOnTheWayUnit = 18;
AQUARAMA_CONSTANT int kRippleTileUnit = 19;
AQUARAMA_CONSTANT int kCloudTileUnit = 20;
AQUARAMA_CONSTANT int kSunHeightsUnit = 21;
AQUARAMA_CONSTANT int kTopHeightsUnit = 22;

// Texture unit of the recorded poses of fish.
AQUARAMA_CONSTANT int kRecordedUnit = 24;

// Texture unit of what visitors have painted.
AQUARAMA_CONSTANT int kDrawnSkinsUnit = 23;

// Texture units of the passes over a picture.
AQUARAMA_CONSTANT int kSceneUnit = 0;
AQUARAMA_CONSTANT int kDepthUnit = 1;
AQUARAMA_CONSTANT int kGlowUnit = 1;
AQUARAMA_CONSTANT int kMomentDepthsUnit = 0;
AQUARAMA_CONSTANT int kPlacesUnit = 1;
AQUARAMA_CONSTANT int kRightSceneUnit = 2;
AQUARAMA_CONSTANT int kRightPlacesUnit = 3;
AQUARAMA_CONSTANT int kBlendUnit = 4;
AQUARAMA_CONSTANT int kBlackUnit = 5;
AQUARAMA_CONSTANT int kCodesUnit = 6;

// Locations of uniforms: fish kernels.
AQUARAMA_CONSTANT int kFractionLocation = 0;
AQUARAMA_CONSTANT int kPlanesLocation = 1;
AQUARAMA_CONSTANT int kSharedEyeLocation = 7;
AQUARAMA_CONSTANT int kLimitsLocation = 8;
AQUARAMA_CONSTANT int kFinestDetailLocation = 15;
AQUARAMA_CONSTANT int kCullsLocation = 16;
AQUARAMA_CONSTANT int kChoosesDetailLocation = 17;
AQUARAMA_CONSTANT int kFishCountLocation = 18;
AQUARAMA_CONSTANT int kPageLocation = 18;
AQUARAMA_CONSTANT int kSpeciesCountLocation = 18;
AQUARAMA_CONSTANT int kRoomVerticesLocation = 19;
AQUARAMA_CONSTANT int kDrawnSpeciesLocation = 20;
AQUARAMA_CONSTANT int kPageCountLocation = 21;

// Locations of uniforms: what grows, and rock.
AQUARAMA_CONSTANT int kReachLocation = 0;
AQUARAMA_CONSTANT int kStirredLocation = 1;
AQUARAMA_CONSTANT int kRockScalesLocation = 1;
AQUARAMA_CONSTANT int kWakeFishCountLocation = 1;

// Locations of uniforms: culling of the place.
AQUARAMA_CONSTANT int kGroupCountLocation = 0;
AQUARAMA_CONSTANT int kInstanceCountLocation = 0;
AQUARAMA_CONSTANT int kCullingLocation = 1;
AQUARAMA_CONSTANT int kCullDetailLocation = 2;
AQUARAMA_CONSTANT int kPatchReachLocation = 2;
AQUARAMA_CONSTANT int kPatchEyeLocation = 3;

// Locations of uniforms: waves, caustics, shafts.
AQUARAMA_CONSTANT int kTileMetresLocation = 0;
AQUARAMA_CONSTANT int kDrawsRipplesLocation = 1;
AQUARAMA_CONSTANT int kTexelMetresLocation = 2;
AQUARAMA_CONSTANT int kReceiverMetresLocation = 0;
AQUARAMA_CONSTANT int kCellsLocation = 1;
AQUARAMA_CONSTANT int kCausticTexelLocation = 2;
AQUARAMA_CONSTANT int kTexelsLocation = 0;
AQUARAMA_CONSTANT int kStepsLocation = 1;

// Locations of uniforms: food.
AQUARAMA_CONSTANT int kFirstLocation = 0;

// Locations of uniforms: projection.
AQUARAMA_CONSTANT int kSizeLocation = 0;
AQUARAMA_CONSTANT int kSeedLocation = 1;
AQUARAMA_CONSTANT int kDitheredLocation = 2;
AQUARAMA_CONSTANT int kBlendMaskLocation = 3;
AQUARAMA_CONSTANT int kModeLocation = 4;
AQUARAMA_CONSTANT int kBrightnessLocation = 5;
AQUARAMA_CONSTANT int kMasksLocation = 6;
AQUARAMA_CONSTANT int kColouredLocation = 7;
AQUARAMA_CONSTANT int kMixLocation = 8;

// Locations of uniforms: pattern.
AQUARAMA_CONSTANT int kWallFromCameraLocation = 0;
AQUARAMA_CONSTANT int kExtentsLocation = 3;
AQUARAMA_CONSTANT int kGreyLightLocation = 4;
AQUARAMA_CONSTANT int kGridLinesLocation = 5;
AQUARAMA_CONSTANT int kEyeAndSizeLocation = 6;
AQUARAMA_CONSTANT int kGroundLocation = 7;
AQUARAMA_CONSTANT int kLocalFromWallLocation = 8;

// Locations of uniforms: text.
AQUARAMA_CONSTANT int kPictureSizeLocation = 0;
AQUARAMA_CONSTANT int kDotPixelsLocation = 1;
// Of a sign.
AQUARAMA_CONSTANT int kSignPlaceLocation = 0;
AQUARAMA_CONSTANT int kSignSizeLocation = 1;
AQUARAMA_CONSTANT int kSignDotsLocation = 2;
AQUARAMA_CONSTANT int kMostSignBytes = 512;  // of its dots

// Vertex attributes and vertex buffers of what grows. The instance that was chosen.
AQUARAMA_CONSTANT int kChosenAttribute = 4;
// How far a patch of sand has faded into the coarser level.
AQUARAMA_CONSTANT int kFadedAttribute = 4;
// Of a vertex on the coarser level: place, normal, albedo.
AQUARAMA_CONSTANT int kCoarseAttribute = 5;
// From so many times the least size of a level on it fades into the next.
AQUARAMA_CONSTANT float kFade = 1.5F;
// Bits of the number of an instance that was chosen; the rest is how far it has faded.
AQUARAMA_CONSTANT int kInstanceBits = 24;

// The kernels that look at one fish or one thing a thread.
AQUARAMA_CONSTANT uint kGroupSize = 64U;

// Samples of a pixel where it has several. OpenGL guarantees so many.
AQUARAMA_CONSTANT int kSamples = 4;

// Drawings of visitors that a node shows at once, at most.
AQUARAMA_CONSTANT uint kMostDrawn = 256U;

// The plan of a view's fish.
AQUARAMA_CONSTANT uint kMostSpecies = 64U;
AQUARAMA_CONSTANT uint kMostPages = 40U;  // of surfaces of fish
AQUARAMA_CONSTANT uint kSurfaces = 4U;    // levels of detail that have a surface
AQUARAMA_CONSTANT uint kMeshes =
    1U + kSurfaces;  // few triangles, then the surfaces from coarse to fine
AQUARAMA_CONSTANT uint kTails = 2U * kMeshes + 1U;  // commands of a species that need no surface
// Lists of a species: one a level of detail for fish in their own skins; so much further on, those
// for fish that wear drawings.
AQUARAMA_CONSTANT uint kDrawnLists = 8U;
AQUARAMA_CONSTANT uint kDetailStride = 2U * kDrawnLists;

// Levels of detail of a fish: surface::DetailLevel.
AQUARAMA_CONSTANT uint kPoint = 0U;
AQUARAMA_CONSTANT uint kFading = 1U;
AQUARAMA_CONSTANT uint kFewTriangles = 2U;
AQUARAMA_CONSTANT uint kControlMesh = 3U;
AQUARAMA_CONSTANT uint kMesh = 4U;
AQUARAMA_CONSTANT uint kHero = 5U;
AQUARAMA_CONSTANT uint kDetails = 7U;  // how many levels there are

// Parts of a fish: body::CagePart.
AQUARAMA_CONSTANT uint kBody = 0U;
AQUARAMA_CONSTANT uint kCaudal = 1U;
AQUARAMA_CONSTANT uint kFirstDorsal = 2U;
AQUARAMA_CONSTANT uint kSecondDorsal = 3U;
AQUARAMA_CONSTANT uint kAnal = 4U;
AQUARAMA_CONSTANT uint kPelvic = 5U;
AQUARAMA_CONSTANT uint kPectoral = 6U;
AQUARAMA_CONSTANT uint kEye = 7U;

// Recorded poses of a species.
AQUARAMA_CONSTANT uint kControlPoints = 426U;
AQUARAMA_CONSTANT uint kPhases = 64U;
AQUARAMA_CONSTANT uint kActions = 38U;
AQUARAMA_CONSTANT uint kFirstTurn = 27U;
AQUARAMA_CONSTANT uint kTurnSegments = 41U;  // of the wire
AQUARAMA_CONSTANT uint kFirstStart = 31U;
AQUARAMA_CONSTANT uint kFirstStartSegment = 191U;  // of the wire
AQUARAMA_CONSTANT uint kStartSegments = 17U;

// The water stirred by fish, about the shared eye: cells of a grid, three numbers each.
AQUARAMA_CONSTANT int kWakeCellsAcross = 40;
AQUARAMA_CONSTANT int kWakeCellsUp = 16;

// Where a test pattern lies, as wall::PatternGround::Kind; else on a cylinder.
AQUARAMA_CONSTANT int kSphereGround = 1;
AQUARAMA_CONSTANT int kPlaneGround = 2;
AQUARAMA_CONSTANT int kFarGround = 3;

// Layouts of a pair of pictures, as config::StereoMode; else an anaglyph.
AQUARAMA_CONSTANT int kSideBySide = 2;
AQUARAMA_CONSTANT int kTopBottom = 3;
AQUARAMA_CONSTANT int kInterlaced = 4;

// Texels along a side of the tiles of sand and rock.
AQUARAMA_CONSTANT int kDetailTexels = 512;

// Texels of the table of a projector's codes, spread evenly over the root of light.
AQUARAMA_CONSTANT int kCodeTexels = 4096;

// Texels of the table of inscattered light: range, rise, azimuth.
AQUARAMA_CONSTANT int kSightRanges = 40;
AQUARAMA_CONSTANT int kSightRises = 32;
AQUARAMA_CONSTANT int kSightAzimuths = 9;

// Sides of square tiles and maps, metres.
AQUARAMA_CONSTANT float kTileMetres = 12.0F;  // caustics and waves; waves have whole numbers on it
AQUARAMA_CONSTANT float kRippleTileMetres = 2.9F;  // the shorter waves
AQUARAMA_CONSTANT float kSandTileMetres = 2.6F;
AQUARAMA_CONSTANT float kRockTileMetres = 1.1F;
AQUARAMA_CONSTANT float kMeanFloorMetres = 8.6F;  // depth of a reef's floor, as common/place has it
AQUARAMA_CONSTANT float kSandMiddleMetres = 13.0F;  // where the middle level of the sand begins
AQUARAMA_CONSTANT float kSandCoarseMetres = 26.0F;  // and the coarsest
AQUARAMA_CONSTANT float kFloorShadeMetres = 72.0F;  // the floor's occlusion, round the origin
AQUARAMA_CONSTANT float kPlaceMetres = 80.0F;       // maps of the place's shadows, round the origin
AQUARAMA_CONSTANT float kMapDepthMetres = 64.0F;    // depth 0 of those maps; 1 is the surface

// Levels of detail of the sand.
AQUARAMA_CONSTANT uint kSandLevels = 3U;

// How far food is seen, metres.
AQUARAMA_CONSTANT float kPlanktonMetres = 8.0F;
AQUARAMA_CONSTANT float kPelletMetres = 16.0F;

// How far the passes over a picture reach, radians. A channel draws a margin of at least kPostReach
// about what its projector shows (channel_picture.cpp), so that neighbours soften and bloom alike
// where they overlap.
// Water scatters by sigma = 0.0016 sqrt(r) rad over r metres; taps go to two sigma.
AQUARAMA_CONSTANT float kScatterSigma = 0.0016F;
AQUARAMA_CONSTANT float kScatterMostSigma = 0.0080F;
// Bloom around bright places: the radii of its rings of taps.
AQUARAMA_CONSTANT float kBloomNear = 0.0035F;
AQUARAMA_CONSTANT float kBloomFar = 0.0095F;
AQUARAMA_CONSTANT float kPostReach = 0.0170F;

#ifdef __cplusplus
}  // namespace aquarama::shaders
#endif
#undef AQUARAMA_CONSTANT
#endif
