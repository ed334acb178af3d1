// SPDX-License-Identifier: Apache-2.0
// Read back with Assimp, which shares no code with the writer.
#include "capture/report/gltf.h"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "capture/report/take.h"
#include "tests/support/scad.h"

namespace aquarama::report {
namespace {

class GltfFile : public testing::TestWithParam<GltfContainer> {
  protected:
    const aiScene& load(motion::Action action, int cycles) {
        const auto bytes = gltfOf(test::scadRepertoire(), body_, action, cycles, GetParam());
        const bool isBinary = GetParam() == GltfContainer::Binary;
        const aiScene* scene = importer_.ReadFileFromMemory(
            bytes.data(), bytes.size(), aiProcess_ValidateDataStructure, isBinary ? "glb" : "gltf");
        if (scene == nullptr) throw std::runtime_error(importer_.GetErrorString());
        return *scene;
    }

    body::FishBody body_ = body::makeBody(test::scad());
    Assimp::Importer importer_;
};
INSTANTIATE_TEST_SUITE_P(As,
                         GltfFile,
                         testing::Values(GltfContainer::Binary, GltfContainer::Text),
                         [](const auto& asked) {
                             return asked.param == GltfContainer::Binary ? "glb" : "gltf";
                         });

glm::vec3 vectorOf(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

TEST_P(GltfFile, theMeshIsTheSkinAtEachOfTheShapes) {
    const motion::Action action = motion::Action::TurnRightSharp;
    const aiScene& scene = load(action, 1);
    const SwimmingSkin skin =
        skinOf(body_,
               test::segmentOf(action),
               static_cast<double>(test::scadRepertoire().recordedLengthMetres),
               gltfShapes(test::segmentOf(action)));
    ASSERT_EQ(scene.mNumMeshes, 1U);
    const aiMesh& mesh = *scene.mMeshes[0];
    ASSERT_EQ(mesh.mNumFaces * 3, skin.triangles.size());
    ASSERT_EQ(mesh.mNumAnimMeshes + 1, skin.shapes.size());
    ASSERT_EQ(mesh.mNumVertices, skin.shapes.front().positions.size());
    for (std::size_t shape = 0; shape < skin.shapes.size(); ++shape) {
        const aiAnimMesh* target = shape == 0 ? nullptr : mesh.mAnimMeshes[shape - 1];
        const aiVector3D* positions = target != nullptr ? target->mVertices : mesh.mVertices;
        const aiVector3D* normals = target != nullptr ? target->mNormals : mesh.mNormals;
        // By corners of triangles: newer releases of Assimp number the vertices anew.
        for (std::size_t corner = 0; corner < skin.triangles.size(); ++corner) {
            const unsigned read = mesh.mFaces[corner / 3].mIndices[corner % 3];
            const auto written = skin.triangles[corner];
            EXPECT_LT(
                glm::distance(vectorOf(positions[read]), skin.shapes[shape].positions[written]),
                1e-6F);
            EXPECT_LT(glm::distance(vectorOf(normals[read]), skin.shapes[shape].normals[written]),
                      1e-5F);
        }
    }
}

TEST_P(GltfFile, theAnimationMovesTheFishAsTheTakeDoes) {
    const motion::Action action = motion::Action::ForwardMedium;
    constexpr int kCycles = 3;
    const aiScene& scene = load(action, kCycles);
    const Take take =
        takeAtPhases(test::scadRepertoire(), action, kCycles, gltfShapes(test::segmentOf(action)));
    ASSERT_EQ(scene.mNumAnimations, 1U);
    const aiAnimation& animation = *scene.mAnimations[0];
    EXPECT_STREQ(animation.mName.C_Str(), "forward_medium");
    EXPECT_NEAR(animation.mDuration / animation.mTicksPerSecond,
                kCycles * static_cast<double>(test::segmentOf(action).periodSeconds),
                1e-5);
    ASSERT_EQ(animation.mNumChannels, 1U);
    const aiNodeAnim& channel = *animation.mChannels[0];
    EXPECT_STREQ(channel.mNodeName.C_Str(), "bigeye_scad");
    ASSERT_EQ(channel.mNumPositionKeys, take.frames.size());
    ASSERT_EQ(channel.mNumRotationKeys, take.frames.size());
    for (std::size_t i = 0; i < take.frames.size(); ++i) {
        EXPECT_LT(glm::distance(vectorOf(channel.mPositionKeys[i].mValue),
                                glm::vec3(take.frames[i].origin)),
                  1e-6F);
        const aiQuaternion& q = channel.mRotationKeys[i].mValue;
        const glm::quat expected(take.frames[i].worldFromBody);
        EXPECT_GT(std::abs(glm::dot(glm::quat(q.w, q.x, q.y, q.z), expected)), 1 - 1e-6F);
    }
}

TEST_P(GltfFile, eachKeyShowsOneShapeInTurn) {
    const motion::Action action = motion::Action::ForwardFast;
    const auto shapes = static_cast<unsigned>(gltfShapes(test::segmentOf(action)));
    const aiScene& scene = load(action, 2);
    const aiAnimation& animation = *scene.mAnimations[0];
    ASSERT_EQ(animation.mNumMorphMeshChannels, 1U);
    const aiMeshMorphAnim& channel = *animation.mMorphMeshChannels[0];
    ASSERT_EQ(channel.mNumKeys, 2 * shapes + 1);
    for (unsigned key = 0; key < channel.mNumKeys; ++key) {
        const aiMeshMorphKey& weights = channel.mKeys[key];
        for (unsigned i = 0; i < weights.mNumValuesAndWeights; ++i) {
            const bool isShown = weights.mValues[i] + 1 == key % shapes;
            EXPECT_EQ(weights.mWeights[i], isShown ? 1.0 : 0.0) << key;
        }
    }
}

// What a viewer shows between two keys.
TEST(Gltf, straightLinesBetweenTheShapesOfABeatStayCloseToTheRecordedOnes) {
    for (const motion::Action action : {motion::Action::ForwardSlow,
                                        motion::Action::ForwardMedium,
                                        motion::Action::ForwardFast}) {
        const SwimmingSkin skin =
            skinOf(body::makeBody(test::scad()), test::segmentOf(action), 1, motion::kPhases);
        ASSERT_EQ(gltfShapes(test::segmentOf(action)), motion::kPhases / 2);
        for (std::size_t k = 1; k < motion::kPhases; k += 2) {
            const auto& before = skin.shapes[k - 1].positions;
            const auto& now = skin.shapes[k].positions;
            const auto& after = skin.shapes[(k + 1) % motion::kPhases].positions;
            for (std::size_t i = 0; i < now.size(); ++i)
                EXPECT_LT(glm::distance(now[i], (before[i] + after[i]) / 2.0F), 0.002F)
                    << motion::nameOf(action) << ' ' << k;
        }
    }
}

}  // namespace
}  // namespace aquarama::report
