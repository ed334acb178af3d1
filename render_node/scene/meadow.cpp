// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/meadow.h"

#include <cmath>
#include <cstddef>

#include "common/place/noise.h"
#include "render_node/gl/program.h"
#include "render_node/scene/plant_mesh.h"
#include "render_node/scene/solid_array.h"

namespace aquarama {

namespace {

struct Format {
    unsigned location;
    int size;
    GLenum type;
    std::size_t offset;
    unsigned binding;
};

void setFormat(unsigned array, const Format& format) {
    glEnableVertexArrayAttrib(array, format.location);
    glVertexArrayAttribFormat(array,
                              format.location,
                              format.size,
                              format.type,
                              format.type == GL_FLOAT ? GL_FALSE : GL_TRUE,
                              static_cast<GLuint>(format.offset));
    glVertexArrayAttribBinding(array, format.location, format.binding);
}

// No two alike: turn, lean and tint from the plant's own seed.
glm::vec4 habitOf(const Plant& plant) {
    const float turn = 6.2831853F * unitOf(hashOf(plant.seed, 1));
    const float most = plant.kind == PlantKind::Kelp ? 0.10F : 0.25F;
    return {std::cos(turn),
            std::sin(turn),
            most * signedUnitOf(hashOf(plant.seed, 2)),
            most * signedUnitOf(hashOf(plant.seed, 3))};
}

glm::vec4 tintAndSwayOf(const Plant& plant) {
    const float bright = 0.8F + 0.4F * unitOf(hashOf(plant.seed, 4));
    const float ripe = 0.15F * signedUnitOf(hashOf(plant.seed, 5));
    const float sway = plant.kind == PlantKind::Kelp ? 0.12F : 0.45F;
    return {bright * (1.0F + ripe), bright, bright * (1.0F - ripe), sway};
}

}  // namespace

Meadow::Meadow(std::uint32_t seed) : program_{gl::makeProgram({"plant.vert", "lit.frag"})} {
    const std::vector<Plant> plants = plantsOf({seed});
    addSpecies(PlantKind::Kelp, plants, {10.5F, 17.0F});
    addSpecies(PlantKind::Seagrass, plants, {8.0F, 13.0F});
    std::vector<PlantVertex> vertices;
    std::vector<std::uint16_t> indices;
    constexpr std::array kKinds{PlantKind::Kelp, PlantKind::Seagrass};
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
        for (int level = 0; level < 3; ++level) {
            const PlantMesh mesh = growPlant(kKinds[kind], level);
            species_[kind].shapes.at(static_cast<std::size_t>(level)) = {
                indices.size() * sizeof(std::uint16_t),
                static_cast<int>(mesh.indices.size()),
                static_cast<int>(vertices.size())};
            vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
            indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
        }
    glNamedBufferStorage(vertices_.name(),
                         static_cast<GLsizeiptr>(vertices.size() * sizeof(PlantVertex)),
                         vertices.data(),
                         0);
    glNamedBufferStorage(indices_.name(),
                         static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)),
                         indices.data(),
                         0);
    glNamedBufferStorage(individuals_.name(),
                         static_cast<GLsizeiptr>(plants.size() * sizeof(Individual)),
                         nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    const unsigned array = array_.name();
    glVertexArrayVertexBuffer(array, 0, vertices_.name(), 0, sizeof(PlantVertex));
    glVertexArrayVertexBuffer(array, 1, individuals_.name(), 0, sizeof(Individual));
    glVertexArrayBindingDivisor(array, 1, 1);
    glVertexArrayElementBuffer(array, indices_.name());
    setFormat(array, {0, 4, GL_FLOAT, offsetof(PlantVertex, offsetAndShare), 0});
    setFormat(array, {1, 4, GL_BYTE, offsetof(PlantVertex, normalAndBlade), 0});
    setFormat(array, {2, 4, GL_UNSIGNED_BYTE, offsetof(PlantVertex, albedo), 0});
    setFormat(array, {4, 4, GL_FLOAT, offsetof(Individual, rootAndHeight), 1});
    setFormat(array, {5, 4, GL_FLOAT, offsetof(Individual, habit), 1});
    setFormat(array, {6, 4, GL_FLOAT, offsetof(Individual, tintAndSway), 1});
}

void Meadow::addSpecies(PlantKind kind,
                        const std::vector<Plant>& plants,
                        std::array<float, 2> limits) {
    Species& species = species_.emplace_back();
    species.levelMetres = limits;
    for (const Plant& plant : plants)
        if (plant.kind == kind)
            species.individuals.push_back(
                {glm::vec4(plant.root, plant.heightMetres), habitOf(plant), tintAndSwayOf(plant)});
}

void Meadow::draw(const Viewpoint& viewpoint) {
    glUseProgram(program_.name());
    glBindVertexArray(array_.name());
    struct Batch {
        const Shape* shape;
        std::size_t first;
    };
    std::vector<Batch> batches;
    chosen_.clear();
    for (const Species& species : species_)
        for (std::size_t level = 0; level < species.shapes.size(); ++level) {
            batches.push_back({&species.shapes[level], chosen_.size()});
            for (const Individual& one : species.individuals) {
                const float height = one.rootAndHeight.w;
                const glm::vec3 middle =
                    glm::vec3(one.rootAndHeight) + glm::vec3{0.0F, 0.5F * height, 0.0F};
                if (viewpoint.levelOf(middle, species.levelMetres) == level &&
                    viewpoint.sees(middle, 0.5F * height + 0.8F))
                    chosen_.push_back(one);
            }
        }
    glNamedBufferSubData(individuals_.name(),
                         0,
                         static_cast<GLsizeiptr>(chosen_.size() * sizeof(Individual)),
                         chosen_.data());
    for (std::size_t i = 0; i < batches.size(); ++i) {
        const std::size_t end = i + 1 < batches.size() ? batches[i + 1].first : chosen_.size();
        if (end == batches[i].first) continue;
        const Shape& shape = *batches[i].shape;
        glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES,
                                                      shape.indexCount,
                                                      GL_UNSIGNED_SHORT,
                                                      byteOffset(shape.firstByte),
                                                      static_cast<GLsizei>(end - batches[i].first),
                                                      shape.firstVertex,
                                                      static_cast<GLuint>(batches[i].first));
    }
}

}  // namespace aquarama
