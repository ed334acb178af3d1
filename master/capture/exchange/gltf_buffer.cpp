// SPDX-License-Identifier: Apache-2.0
#include "master/capture/exchange/gltf_buffer.h"

#include <bit>

#include <glm/common.hpp>

namespace aquarama::exchange {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

constexpr int kNoTarget = 0;

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
    return static_cast<int>(model.accessors.size()) - 1;
}

template <class T>
int addFloats(tinygltf::Model& model, std::span<const T> values, int target, int type) {
    return addAccessor(model, values, target, type, TINYGLTF_COMPONENT_TYPE_FLOAT);
}

}  // namespace

int addTriangles(tinygltf::Model& model, std::span<const std::uint32_t> corners) {
    return addAccessor(model,
                       corners,
                       TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                       TINYGLTF_TYPE_SCALAR,
                       TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
}

int addVertices(tinygltf::Model& model, std::span<const glm::vec3> vectors) {
    const int accessor =
        addFloats(model, vectors, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_TYPE_VEC3);
    glm::vec3 least = vectors.front();
    glm::vec3 most = least;
    for (const glm::vec3& vector : vectors) {
        least = glm::min(least, vector);
        most = glm::max(most, vector);
    }
    const auto numbers = [](const glm::dvec3& v) { return std::vector<double>{v.x, v.y, v.z}; };
    model.accessors.back().minValues = numbers(glm::dvec3(least));
    model.accessors.back().maxValues = numbers(glm::dvec3(most));
    return accessor;
}

int addTimes(tinygltf::Model& model, std::span<const float> seconds) {
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

}  // namespace aquarama::exchange
