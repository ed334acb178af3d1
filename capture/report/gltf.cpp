// SPDX-License-Identifier: Apache-2.0
#include "capture/report/gltf.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <sstream>
#include <string>

#include <glm/common.hpp>

#include "capture/measure.h"
#include "capture/report/take.h"
#include "common/base/log.h"
#include "common/skin/limit_table.h"

namespace aquarama::report {

namespace {

// Skin.

// Level of subdivision: 1698 vertices. Positions and normals are those of the limit surface.
constexpr int kSurfaceLevel = 1;

// Nodal points in the body frame, body lengths, as poseCage() takes them.
body::NodalPoints nodesAt(const motion::ActionSegment& segment, std::size_t phase) {
    body::NodalPoints nodes{};
    std::ranges::transform(capture::poseAt(segment, phase),
                           nodes.begin(),
                           [](const glm::dvec3& node) { return glm::vec3(node); });
    return nodes;
}

// Poses the cage by the nodal points, then evaluates the limit surface at each vertex.
SkinShape shapeOf(const body::FishBody& body,
                  const skin::LimitTable& table,
                  const body::NodalPoints& nodes,
                  float lengthMetres) {
    std::vector<glm::vec3> cage(body.cage.vertices.size());
    body::poseCage(body, nodes, cage);
    SkinShape shape;
    for (std::size_t i = 0; i < table.vertices.size(); ++i) {
        const skin::SkinPoint point = skin::skinPoint(table, i, cage);
        shape.positions.push_back(point.position * lengthMetres);
        shape.normals.push_back(point.normal);
    }
    return shape;
}

}  // namespace

SwimmingSkin skinOf(const body::FishBody& body,
                    const motion::ActionSegment& segment,
                    double lengthMetres,
                    int shapes) {
    assert(shapes >= 1);
    assert(motion::kPhases % shapes == 0);
    const skin::LimitTable table = skin::makeLimitTable(body, kSurfaceLevel);
    SwimmingSkin skin{.triangles = table.indices, .shapes = {}};
    for (int phase = 0; phase < motion::kPhases; phase += motion::kPhases / shapes)
        skin.shapes.push_back(shapeOf(body,
                                      table,
                                      nodesAt(segment, static_cast<std::size_t>(phase)),
                                      static_cast<float>(lengthMetres)));
    return skin;
}

namespace {

// Accessors.

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

// For a buffer view that is not for a GPU buffer, as of an animation.
constexpr int kNoTarget = 0;

// `type` is the number of components (TINYGLTF_TYPE_...), `component` the type of each. All element
// types here are multiples of four bytes, so that every view is aligned as glTF demands.
template <class T>
int addAccessor(
    tinygltf::Model& model, std::span<const T> values, int target, int type, int component) {
    if (model.buffers.empty()) model.buffers.emplace_back();
    std::vector<unsigned char>& data = model.buffers[0].data;
    const auto bytes = std::as_bytes(values);

    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = bytes.size();
    view.target = target;
    for (const std::byte byte : bytes) data.push_back(std::to_integer<unsigned char>(byte));
    model.bufferViews.push_back(view);

    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.count = values.size();
    accessor.type = type;
    model.accessors.push_back(accessor);
    assert(data.size() % 4 == 0);
    return static_cast<int>(model.accessors.size()) - 1;
}

template <class T>
int addFloats(tinygltf::Model& model, std::span<const T> values, int target, int type) {
    return addAccessor(model, values, target, type, TINYGLTF_COMPONENT_TYPE_FLOAT);
}

}  // namespace

// Indices go to an element array buffer, vertices to an array buffer; keys have no target.
int addTriangles(tinygltf::Model& model, std::span<const std::uint32_t> corners) {
    return addAccessor(model,
                       corners,
                       TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                       TINYGLTF_TYPE_SCALAR,
                       TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
}

int addVertices(tinygltf::Model& model, std::span<const glm::vec3> vectors) {
    assert(!vectors.empty());
    const int accessor =
        addFloats(model, vectors, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_TYPE_VEC3);
    glm::vec3 least = vectors.front();
    glm::vec3 most = least;
    for (const glm::vec3& vector : vectors) {
        least = glm::min(least, vector);
        most = glm::max(most, vector);
    }
    // tinygltf holds bounds as doubles; the conversion from float is exact.
    const auto numbers = [](const glm::dvec3& v) { return std::vector<double>{v.x, v.y, v.z}; };
    model.accessors.back().minValues = numbers(glm::dvec3(least));
    model.accessors.back().maxValues = numbers(glm::dvec3(most));
    return accessor;
}

int addTimes(tinygltf::Model& model, std::span<const float> seconds) {
    assert(!seconds.empty());
    const int accessor = addKeys(model, seconds);
    model.accessors.back().minValues = {static_cast<double>(seconds.front())};
    model.accessors.back().maxValues = {static_cast<double>(seconds.back())};
    return accessor;
}

int addKeys(tinygltf::Model& model, std::span<const float> numbers) {
    return addFloats(model, numbers, kNoTarget, TINYGLTF_TYPE_SCALAR);
}

int addKeys(tinygltf::Model& model, std::span<const glm::vec3> vectors) {
    return addFloats(model, vectors, kNoTarget, TINYGLTF_TYPE_VEC3);
}

int addKeys(tinygltf::Model& model, std::span<const glm::vec4> quaternions) {
    return addFloats(model, quaternions, kNoTarget, TINYGLTF_TYPE_VEC4);
}

namespace {

// The model. Each add... function appends one object to the model; where it returns an int, that is
// the object's index.

// Element by element; of equal sizes.
std::vector<glm::vec3> minus(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    std::vector<glm::vec3> difference = a;
    for (std::size_t i = 0; i < a.size(); ++i) difference[i] -= b[i];
    return difference;
}

// A plain grey-blue: the skin shaders of the show have no counterpart in glTF.
int addMaterial(tinygltf::Model& model) {
    tinygltf::Material material;
    material.name = "skin";
    material.pbrMetallicRoughness.baseColorFactor = {0.45, 0.55, 0.62, 1};
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.5;
    model.materials.push_back(material);
    return 0;
}

// The mesh is the shape at phase 0. The morph targets are the differences from it to each of the
// other shapes, as glTF defines them.
int addMesh(tinygltf::Model& model, const SwimmingSkin& skin) {
    const SkinShape& first = skin.shapes.front();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.indices = addTriangles(model, skin.triangles);
    primitive.material = addMaterial(model);
    primitive.attributes["POSITION"] = addVertices(model, first.positions);
    primitive.attributes["NORMAL"] = addVertices(model, first.normals);
    tinygltf::Mesh mesh;
    mesh.name = "skin";
    tinygltf::Value::Array names;
    for (std::size_t i = 1; i < skin.shapes.size(); ++i) {
        const SkinShape& shape = skin.shapes[i];
        primitive.targets.push_back(
            {{"POSITION", addVertices(model, minus(shape.positions, first.positions))},
             {"NORMAL", addVertices(model, minus(shape.normals, first.normals))}});
        names.emplace_back("phase " + std::to_string(i) + " of " +
                           std::to_string(skin.shapes.size()));
    }
    mesh.primitives.push_back(primitive);
    mesh.weights.assign(primitive.targets.size(), 0);
    // What Blender and others call the targets.
    mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(names)}});
    model.meshes.push_back(mesh);
    return 0;
}

// The keys of the weights, frame by frame. At frame i of the take the shape i modulo `shapes` has
// the whole weight; shape 0 is the mesh itself, where all weights are 0.
std::vector<float> weightsOf(const Take& take, std::size_t shapes) {
    const std::size_t targets = shapes - 1;
    std::vector<float> weights(take.frames.size() * targets, 0.0F);
    for (std::size_t i = 0; i < take.frames.size(); ++i) {
        const std::size_t shape = i % shapes;
        if (shape > 0) weights[i * targets + shape - 1] = 1.0F;
    }
    return weights;
}

// Three channels on one time axis: translation, rotation (x, y, z, w) and weights of the node.
void addAnimation(tinygltf::Model& model, const Take& take, std::size_t shapes, int node) {
    std::vector<float> times;
    std::vector<glm::vec3> translations;
    std::vector<glm::vec4> rotations;
    for (const TakeFrame& frame : take.frames) {
        times.push_back(static_cast<float>(frame.seconds));
        translations.emplace_back(frame.origin);
        const glm::quat q(frame.worldFromBody);
        rotations.emplace_back(q.x, q.y, q.z, q.w);
    }
    tinygltf::Animation animation;
    animation.name = take.segment;
    // The channels share the accessor of the times.
    const int input = addTimes(model, times);
    const auto animate = [&](const char* path, int keys) {
        tinygltf::AnimationSampler sampler;
        sampler.input = input;
        sampler.output = keys;
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(animation.samplers.size());
        channel.target_node = node;
        channel.target_path = path;
        animation.samplers.push_back(sampler);
        animation.channels.push_back(channel);
    };
    animate("translation", addKeys(model, std::span<const glm::vec3>(translations)));
    animate("rotation", addKeys(model, std::span<const glm::vec4>(rotations)));
    animate("weights", addKeys(model, std::span<const float>(weightsOf(take, shapes))));
    model.animations.push_back(animation);
}

// The only node, and the scene that shows it.
int addFish(tinygltf::Model& model, const std::string& species, int mesh) {
    tinygltf::Node node;
    node.name = species;
    node.mesh = mesh;
    model.nodes.push_back(node);
    tinygltf::Scene scene;
    scene.nodes = {0};
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    return 0;
}

// Encodes the model in memory; no file is touched.
std::vector<std::byte> written(const tinygltf::Model& model, GltfContainer container) {
    std::ostringstream stream;
    const bool isBinary = container == GltfContainer::Binary;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, !isBinary, isBinary))
        throw Error("the glTF model cannot be written; ask for fewer cycles");
    const std::string text = std::move(stream).str();
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

int gltfShapes(const motion::ActionSegment& segment) {
    return segment.playsToEnd ? motion::kPhases : motion::kPhases / 2;
}

std::vector<std::byte> gltfOf(const motion::Repertoire& repertoire,
                              const body::FishBody& body,
                              motion::Action action,
                              int cycles,
                              GltfContainer container) {
    const motion::ActionSegment& segment = repertoire.segments.at(static_cast<std::size_t>(action));
    const int shapes = gltfShapes(segment);
    const Take take = takeAtPhases(repertoire, action, cycles, shapes);
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "Aquarama";
    const SwimmingSkin skin = skinOf(body, segment, take.lengthMetres, shapes);
    const int node = addFish(model, take.species, addMesh(model, skin));
    addAnimation(model, take, skin.shapes.size(), node);
    return written(model, container);
}

}  // namespace aquarama::report
