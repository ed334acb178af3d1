// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/fish_tables.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <glm/vec3.hpp>

#include "common/base/derived_cache.h"
#include "common/base/log.h"
#include "common/body/fins.h"
#include "common/skin/limit_table.h"
#include "render_node/gl/handle.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::surface {

static_assert(shaders::kControlPoints == body::kControlPoints &&
              shaders::kPhases == motion::kPhases && shaders::kActions == motion::kActions &&
              shaders::kFirstTurn == motion::kFirstTurn &&
              shaders::kTurnSegments == motion::kTurnSegments &&
              shaders::kFirstStart == motion::kFirstStart &&
              shaders::kFirstStartSegment == motion::kFirstStartSegment &&
              shaders::kStartSegments == motion::kStartSegments);

template <class Enum>
constexpr bool isAt(std::uint32_t number, Enum value) {
    return number == static_cast<std::uint32_t>(value);
}
static_assert(isAt(shaders::kPoint, DetailLevel::Point) &&
              isAt(shaders::kFading, DetailLevel::Fading) &&
              isAt(shaders::kFewTriangles, DetailLevel::FewTriangles) &&
              isAt(shaders::kControlMesh, DetailLevel::ControlMesh) &&
              isAt(shaders::kMesh, DetailLevel::Mesh) && isAt(shaders::kHero, DetailLevel::Hero) &&
              shaders::kDetails == kDetailLevels);
static_assert(isAt(shaders::kBody, body::CagePart::Body) &&
              isAt(shaders::kCaudal, body::CagePart::Caudal) &&
              isAt(shaders::kFirstDorsal, body::CagePart::FirstDorsal) &&
              isAt(shaders::kSecondDorsal, body::CagePart::SecondDorsal) &&
              isAt(shaders::kAnal, body::CagePart::Anal) &&
              isAt(shaders::kPelvic, body::CagePart::Pelvic) &&
              isAt(shaders::kPectoral, body::CagePart::Pectoral) &&
              isAt(shaders::kEye, body::CagePart::Eye));

namespace {

// Rounds a place to 16 bits; the heading follows later. The negated comparison also rejects NaN.
RecordedPoint quantised(glm::vec3 point) {
    RecordedPoint recorded{};
    for (int axis = 0; axis < 3; ++axis) {
        const float value = std::round(point[axis] / motion::kPoseUnit);
        if (!(std::abs(value) <= 32767))
            throw Error("a control point lies further than a body length from its fish");
        recorded.at(static_cast<std::size_t>(axis)) = static_cast<std::int16_t>(value);
    }
    return recorded;
}

// Nodal points of a recorded pose, body lengths.
body::NodalPoints nodesOf(const motion::NodalPose& pose) {
    body::NodalPoints nodes{};
    for (std::size_t n = 0; n < nodes.size(); ++n)
        nodes.at(n) = glm::vec3(pose.at(n)[0], pose.at(n)[1], pose.at(n)[2]) * motion::kPoseUnit;
    return nodes;
}

// Appends the control points that the body computes from its nodal points.
void addPosed(const body::FishBody& body,
              const body::NodalPoints& nodes,
              std::vector<RecordedPoint>& points) {
    std::vector<glm::vec3> cage(body::kControlPoints);
    body::poseCage(body, nodes, cage);
    std::ranges::transform(cage, std::back_inserter(points), quantised);
}

// Sets the headings of the last kControlPoints points, which are those of one pose.
void addHeadings(const body::FishBody& body,
                 const body::NodalPoints& nodes,
                 std::vector<RecordedPoint>& points) {
    std::array<float, body::kControlPoints> headings{};
    body::headingsOf(body, nodes, headings);
    assert(points.size() >= headings.size());
    const std::size_t first = points.size() - headings.size();
    for (std::size_t i = 0; i < headings.size(); ++i)
        points[first + i][3] = static_cast<std::int16_t>(
            std::lround(headings.at(i) / std::numbers::pi_v<float> * 32767.0F));
}

// Appends the captured poses of the pectoral fins, by action and phase, left and right.
void addFinPoses(const motion::Repertoire& repertoire, std::vector<RecordedPoint>& points) {
    for (const motion::ActionSegment& segment : repertoire.segments)
        for (const motion::FinAnglePair& fins : segment.fins)
            for (const auto& [open, stroke, twist] : fins)
                points.push_back({open, stroke, twist, 0});
}

// Appends the fin tables behind the poses of a species, as raw bytes: fish_pose.glsl reads them
// from the same buffer because OpenGL guarantees only eight storage blocks.
void addFins(const body::FinTable& fins, std::vector<RecordedPoint>& points) {
    const auto add = [&](std::span<const std::byte> bytes) {
        const std::size_t first = points.size();
        points.resize(first + bytes.size() / sizeof(RecordedPoint));
        std::memcpy(&points[first], bytes.data(), bytes.size());
    };
    add(std::as_bytes(std::span(&fins.style, 1)));
    add(std::as_bytes(std::span(fins.points)));
}

}  // namespace

std::vector<RecordedPoint> recordedPoints(const body::FishBody& body,
                                          const motion::Repertoire& repertoire) {
    std::vector<RecordedPoint> points;
    points.reserve(std::size_t{motion::kActions} * motion::kPhases * body::kControlPoints);
    for (const motion::ActionSegment& segment : repertoire.segments) {
        assert(segment.controlPoints.empty() || segment.controlPoints.size() == motion::kPhases);
        for (std::size_t phase = 0; phase < motion::kPhases; ++phase) {
            const body::NodalPoints nodes = nodesOf(segment.nodes.at(phase));
            if (segment.controlPoints.empty()) {
                addPosed(body, nodes, points);
            } else {
                for (const auto& [x, y, z] : segment.controlPoints[phase])
                    points.push_back({x, y, z, 0});
            }
            addHeadings(body, nodes, points);
        }
    }
    return points;
}

float reachOf(std::span<const RecordedPoint> points) {
    float reach = 0.0F;
    for (const auto& [x, y, z, unused] : points)
        reach = std::max(reach, glm::length(glm::vec3(x, y, z)));
    return reach * motion::kPoseUnit;
}

namespace {

template <class T>
// Appends and returns the index of the first new element.
std::uint32_t append(std::vector<T>& all, std::span<const T> more) {
    const auto first = static_cast<std::uint32_t>(all.size());
    all.insert(all.end(), more.begin(), more.end());
    return first;
}

// As packNormal() of fish_data.glsl.
std::uint32_t packedNormal(glm::vec3 normal) {
    std::uint32_t bits = 0;
    for (int k = 0; k < 3; ++k) {
        const auto number = static_cast<std::int32_t>(std::lround(normal[k] * 511.0F));
        bits |= (static_cast<std::uint32_t>(number) & 1023U) << static_cast<unsigned>(10 * k);
    }
    return bits;
}

// Sets the areas that a pose covers from three sides, its middle and its reach. Fins are half
// transparent and count half.
void measure(const skin::LimitTable& mesh,
             std::span<const RecordedPoint> pose,
             SpeciesTables& tables) {
    constexpr float kFinOpacity = 0.5F;
    std::vector<glm::vec3> points;
    for (const auto& [x, y, z, unused] : pose.first(body::kControlPoints))
        points.push_back(glm::vec3(x, y, z) * motion::kPoseUnit);
    std::vector<glm::vec3> places;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        places.push_back(skin::skinPoint(mesh, i, points).position);
    glm::vec3 area{}, moment{};
    float side = 0.0F;
    // Sum of the projected areas of the triangles.
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const glm::vec3 a = places[mesh.indices[t]], b = places[mesh.indices[t + 1]],
                        c = places[mesh.indices[t + 2]];
        const float weight = t < mesh.bodyIndices ? 1.0F : kFinOpacity;
        // A closed surface covers its area once by its front and once by its back.
        const glm::vec3 own = 0.25F * weight * glm::abs(glm::cross(b - a, c - a));
        area += own;
        moment += own.z * (a + b + c) / 3.0F;
        side += own.z;
    }
    // Attachments, such as whips, are not control points: they may reach further, and they swing.
    float reach = tables.area.w;
    for (std::size_t i = mesh.skinVertices; i < places.size(); ++i)
        reach = std::max(reach, 1.1F * glm::length(places[i]));
    tables.area = glm::vec4{area, reach};
    tables.middle = glm::vec4{moment / side, 0.0F};
}

// Appends the tables of one species after the other to the shared arrays.
class Gatherer {
  public:
    SpeciesTables add(const SchoolSpecies& species, std::size_t finest) {
        SpeciesTables tables;
        const std::vector<RecordedPoint> points = recordedPoints(species.body, species.repertoire);
        append<RecordedPoint>(all_.recorded, points);
        addFinPoses(species.repertoire, all_.recorded);
        addFins(species.body.fins, all_.recorded);
        tables.area.w = reachOf(points);
        skin::LimitTable coarser = skin::makeLimitTable(species.body, 0);
        const FewTriangles few = makeFewTriangles(species.body, coarser);
        tables.meshes[0] = add(few);
        for (std::size_t surface = 0; surface <= finest; ++surface) {
            const skin::LimitTable table =
                skin::makeLimitTable(species.body, static_cast<int>(surface));
            tables.meshes.at(1 + surface) = add(species.body, surface, table, coarser, few);
            if (surface == 0) addPlaces(few);
            if (surface == 1) measure(table, points, tables);
            coarser = table;
        }
        isFirst_ = false;
        return tables;
    }

    [[nodiscard]] FishArrays take() { return std::move(all_); }

  private:
    SpeciesTables::Mesh add(const FewTriangles& few) {
        SpeciesTables::Mesh mesh{};
        mesh.vertices = static_cast<std::uint32_t>(few.vertices.size());
        mesh.firstVertex = append<FewTriangles::Vertex>(all_.fewVertices, few.vertices);
        mesh.firstBodyIndex = append<std::uint32_t>(all_.fewIndices, few.indices);
        mesh.bodyIndices = static_cast<std::uint32_t>(few.bodyIndices);
        mesh.firstFinIndex = mesh.firstBodyIndex + mesh.bodyIndices;
        mesh.finIndices = static_cast<std::uint32_t>(few.indices.size() - few.bodyIndices);
        return mesh;
    }

    // Parents of the control mesh's vertices, as fish.comp unpacks them: three control points of 9
    // bits, two weights of 16 bits, a packed normal.
    void addPlaces(const FewTriangles& few) {
        for (const FewTriangles::Place& place : few.cage) {
            const auto& [a, b, c] = place.controlPoints;
            all_.parents.push_back(a | b << 9U | c << 18U);
            all_.parents.push_back(glm::packUnorm2x16({place.weights[0], place.weights[1]}));
            all_.parents.push_back(packedNormal(place.normal));
        }
    }

    SpeciesTables::Mesh add(const body::FishBody& body,
                            std::size_t surface,
                            const skin::LimitTable& table,
                            const skin::LimitTable& coarser,
                            const FewTriangles& few) {
        SpeciesTables::Mesh mesh{};
        mesh.vertices = static_cast<std::uint32_t>(table.vertices.size());
        mesh.firstEntry = addStencils(surface, table);
        mesh.firstParent = static_cast<std::uint32_t>(all_.parents.size());
        mesh.firstVertex = static_cast<std::uint32_t>(all_.places.size());
        if (surface == 0)
            addVertices(table, few);
        else
            addVertices(table,
                        surface == 1 ? coarser : table,
                        skin::coarserParents(body, static_cast<int>(surface), coarser));
        mesh.firstBodyIndex = append<std::uint32_t>(all_.indices, table.indices);
        mesh.bodyIndices = static_cast<std::uint32_t>(table.bodyIndices);
        mesh.firstFinIndex = mesh.firstBodyIndex + mesh.bodyIndices;
        mesh.finIndices = static_cast<std::uint32_t>(table.indices.size() - table.bodyIndices);
        return mesh;
    }

    void addVertices(const skin::LimitTable& controlMesh, const FewTriangles& few) {
        for (std::size_t i = 0; i < controlMesh.vertices.size(); ++i)
            all_.places.push_back(
                {controlMesh.vertices[i], few.cage.at(i).place.rest, few.cage.at(i).place.fin});
    }
    // Vertices of a refined surface and their two parents of the coarser one. coarser: the table
    // whose skin the parents have.
    void addVertices(const skin::LimitTable& table,
                     const skin::LimitTable& coarser,
                     std::span<const std::array<std::uint32_t, 2>> pairs) {
        for (std::uint32_t i = 0; i < table.vertices.size(); ++i) {
            if (i >= table.skinVertices) {  // an attachment, the same at every level
                all_.parents.push_back(i | i << 16U);
                all_.places.push_back(
                    {table.vertices[i], table.vertices[i].rest, table.vertices[i].fin});
                continue;
            }
            const auto& [a, b] = pairs[i];
            all_.parents.push_back(a | b << 16U);
            const skin::SkinPlace &one = coarser.vertices.at(a), &other = coarser.vertices.at(b);
            all_.places.push_back(
                {table.vertices[i], 0.5F * (one.rest + other.rest), 0.5F * (one.fin + other.fin)});
        }
    }

    // All species have the same topology, so that the stencils of the first usually serve the
    // others; they are stored again only where they differ.
    std::uint32_t addStencils(std::size_t surface, const skin::LimitTable& table) {
        Stencils& shared = shared_.at(surface);
        const bool serves = std::ranges::equal(table.entries, shared.entries, sameEntry) &&
                            table.firstEntry == shared.firstEntry;
        if (!isFirst_ && serves) return shared.at;
        const auto firstOfAll = static_cast<std::uint32_t>(all_.entries.size());
        append<skin::StencilEntry>(all_.entries, table.entries);
        const auto at = static_cast<std::uint32_t>(all_.firstEntry.size());
        for (const std::uint32_t first : table.firstEntry)
            all_.firstEntry.push_back(firstOfAll + first);
        if (isFirst_) shared = {table.firstEntry, table.entries, at};
        return at;
    }
    static bool sameEntry(const skin::StencilEntry& a, const skin::StencilEntry& b) {
        return a.controlPoint == b.controlPoint && a.position == b.position &&
               a.tangentU == b.tangentU && a.tangentV == b.tangentV;
    }

    struct Stencils {
        std::vector<std::uint32_t> firstEntry;
        std::vector<skin::StencilEntry> entries;
        std::uint32_t at = 0;
    };
    std::array<Stencils, kSurfaces> shared_;
    FishArrays all_;
    bool isFirst_ = true;
};

FishArrays makeFishArrays(std::span<const SchoolSpecies> cast, std::size_t finest) {
    Gatherer gatherer;
    std::vector<SpeciesTables> species;
    for (const SchoolSpecies& member : cast) species.push_back(gatherer.add(member, finest));
    FishArrays arrays = gatherer.take();
    arrays.species = std::move(species);
    return arrays;
}

// Sets the numbers of fish and groups, which follow from the cast alone and are not cached.
void countFish(std::span<const SchoolSpecies> cast, std::vector<SpeciesTables>& species) {
    assert(species.size() == cast.size());
    std::size_t firstFish = 0;
    std::size_t groups = 0;
    for (std::size_t i = 0; i < cast.size(); ++i) {
        const std::size_t fish = cast[i].fish.size();
        species[i].firstFish = static_cast<std::uint32_t>(firstFish);
        species[i].fish = static_cast<std::uint32_t>(fish);
        species[i].firstGroup = static_cast<std::uint32_t>(groups);
        species[i].groups = static_cast<std::uint32_t>((fish + kGroup - 1) / kGroup);
        firstFish += fish;
        groups += species[i].groups;
    }
}

// Whether the tables may be cached.
bool allHaveSources(std::span<const SchoolSpecies> cast) {
    return std::ranges::all_of(cast,
                               [](const SchoolSpecies& one) { return one.source.has_value(); });
}

}  // namespace

FishArrays fishArrays(std::span<const SchoolSpecies> cast, std::size_t finest) {
    assert(finest < kSurfaces);
    if (cast.size() > kMostSpecies)
        throw Error("a scene has more than " + std::to_string(kMostSpecies) +
                    " species; leave some out");
    DerivedKey key("fish");
    key.add(finest);
    for (const SchoolSpecies& member : cast)
        if (member.source) key.add(std::as_bytes(std::span{member.source->bytes}));
    const auto make = [&] { return makeFishArrays(cast, finest); };
    FishArrays arrays = allHaveSources(cast) ? derivedTables<FishArrays>(key, make) : make();
    countFish(cast, arrays.species);
    return arrays;
}

namespace {

// Throws Error where the poses of the species are more than a shader can read of one texture.
void requireRoom(const FishArrays& arrays) {
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    const std::size_t points = arrays.recorded.size();
    if (std::cmp_less_equal(points, most)) return;
    const std::size_t species = arrays.species.size();
    throw Error(std::to_string(species) + " species: their poses are " + std::to_string(points) +
                " points, and this graphics card has room for " + std::to_string(most) + "; show " +
                std::to_string(static_cast<std::size_t>(most) / (points / species)) +
                " species at most");
}

}  // namespace

FishTables::FishTables(const FishArrays& arrays, std::size_t finest) {
    assert(finest < kSurfaces);
    requireRoom(arrays);
    for (const SpeciesTables& species : arrays.species) {
        groups += species.groups;
        mostVertices = std::max<std::size_t>(mostVertices, species.meshes.at(1 + finest).vertices);
    }
    cast = gl::makeBuffer(arrays.species, "cast");
    recorded = gl::makeBuffer(arrays.recorded, "recorded control points");
    glTextureBuffer(poses.name(), GL_RG32UI, recorded.name());
    firstEntries = gl::makeBuffer(arrays.firstEntry, "stencil offsets");
    entries = gl::makeBuffer(arrays.entries, "stencil entries");
    parents = gl::makeBuffer(arrays.parents, "parents of vertices");
    fewVertices = gl::makeBuffer(arrays.fewVertices, "few vertices");
    fewIndices = gl::makeBuffer(arrays.fewIndices, "few indices");
    places = gl::makeBuffer(arrays.places, "skin places");
    indices = gl::makeBuffer(arrays.indices, "fish indices");
}

}  // namespace aquarama::surface
