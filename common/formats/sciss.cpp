// SPDX-License-Identifier: Apache-2.0
// Reads SCISS sgc: a pose, edges and a mesh. Places are from the top left, texture coordinates from
// the bottom left of the picture of the frustum.
#include <algorithm>
#include <cmath>

#include <glm/trigonometric.hpp>

#include "common/base/log.h"
#include "common/formats/vendors.h"

namespace aquarama::formats {

namespace {

constexpr std::size_t kVertexBytes = 24;
constexpr std::uint32_t kPlanar = 0, kCube = 1;
// The first count of version 2: OpenGL's names for the ways in which indices form triangles.
constexpr std::uint32_t kTriangles = 4, kStrip = 5;

struct ScissHeader {
    std::uint8_t version = 0;
    Frustum frustum;
    glm::dvec3 position{};
    std::uint32_t columns = 0, rows = 0;  // of version 1
    std::uint32_t primitive = kStrip;
    std::uint64_t vertices = 0;
};

Frustum readPose(VendorBytes& in) {
    std::array<double, 4> q{};
    for (double& part : q) part = in.number();
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (length < 0.9 || length > 1.1) in.fail("its rotation is no unit quaternion; export it anew");
    return turned(q[0] / length, q[1] / length, q[2] / length, q[3] / length);
}

// Up, down, left, right; all signed, from the axis.
void readEdges(VendorBytes& in, Frustum& frustum) {
    for (double* edge : {&frustum.up, &frustum.down, &frustum.left, &frustum.right}) {
        const double degrees = in.number();
        if (std::abs(degrees) > kWidestEdgeDegrees)
            in.fail("an edge is more than 89.9 degrees from the axis; export it anew");
        *edge = glm::radians(degrees);
    }
    if (frustum.left >= frustum.right || frustum.down >= frustum.up)
        in.fail("its edges enclose no picture; export it anew");
}

void readCounts(VendorBytes& in, ScissHeader& header) {
    header.columns = in.u32();
    header.rows = in.u32();
    header.vertices = std::uint64_t{header.columns} * header.rows;
    if (header.version == 2) {
        header.primitive = header.columns;
        header.vertices = header.rows;
        if (header.primitive != kTriangles && header.primitive != kStrip)
            in.fail("its mesh is neither triangles nor a strip; export it anew");
    }
    if (header.vertices < 3 || header.vertices > kMostVertices)
        in.fail("no mesh has " + std::to_string(header.vertices) + " vertices; export it anew");
    in.need(header.vertices, kVertexBytes, "vertices");
}

// Reads the header, up to the vertices. Throws Error where no mesh can follow.
ScissHeader readScissHeader(VendorBytes& in) {
    ScissHeader header;
    in.go(3);
    header.version = in.u8();
    if (header.version != 1 && header.version != 2)
        in.fail("is version " + std::to_string(header.version) +
                " of SGC, only 1 and 2 are known; export it so");
    const std::uint32_t type = in.u32();
    if (type == kCube) in.fail("its mapping is a cube map; export it as planar");
    if (type != kPlanar)
        in.fail("its mapping " + std::to_string(type) + " is not known; export it as planar");
    header.frustum = readPose(in);
    for (int i = 0; i < 3; ++i) header.position[i] = in.number();
    readEdges(in, header.frustum);
    readCounts(in, header);
    return header;
}

std::vector<WarpMesh::Vertex> readVertices(VendorBytes& in, std::uint64_t count) {
    std::vector<WarpMesh::Vertex> vertices;
    vertices.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        WarpMesh::Vertex vertex{};
        vertex.place.x = in.number();
        vertex.place.y = in.number();
        in.go(in.at() + 4);
        vertex.target.x = in.number();
        vertex.target.y = 1 - in.number();
        in.go(in.at() + 4);
        vertices.push_back(vertex);
    }
    return vertices;
}

// Reads the indices. Each must name an existing vertex.
std::vector<std::uint32_t> readIndices(VendorBytes& in, std::uint64_t vertices) {
    const std::uint32_t count = in.u32();
    in.need(count, 4, "indices");
    if (count > 6 * kMostVertices) in.fail("has too many indices; export a coarser mesh");
    std::vector<std::uint32_t> indices;
    indices.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        indices.push_back(in.u32());
        if (indices.back() >= vertices)
            in.fail("names vertex " + std::to_string(indices.back()) + " of " +
                    std::to_string(vertices) + "; export it anew");
    }
    return indices;
}

std::vector<std::array<std::uint32_t, 3>> trianglesOf(const std::vector<std::uint32_t>& indices,
                                                      std::size_t step) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i + 2 < indices.size(); i += step)
        triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    return triangles;
}

// Past its last index.
WarpMesh readMesh(VendorBytes& in, const ScissHeader& header) {
    WarpMesh mesh;
    mesh.vertices = readVertices(in, header.vertices);
    const std::vector<std::uint32_t> indices = readIndices(in, header.vertices);
    mesh.triangles = trianglesOf(indices, header.primitive == kTriangles ? 3 : 1);
    if (mesh.triangles.empty()) in.fail("its mesh has no triangle; export it anew");
    return mesh;
}

}  // namespace

bool isSciss(std::span<const std::byte> bytes) {
    return beginning(bytes, 3) == "SGC";
}

WarpMesh scissMesh(std::span<const std::byte> bytes, const std::string& source) {
    VendorBytes in(bytes, source);
    const ScissHeader header = readScissHeader(in);
    return readMesh(in, header);
}

WallFile readSciss(std::span<const std::byte> bytes,
                   const std::string& source,
                   const ReadOptions& options) {
    VendorBytes in(bytes, source);
    const ScissHeader header = readScissHeader(in);
    FileChannel channel;
    channel.name = stemOf(source);
    channel.frustum = header.frustum;
    channel.coordinateFrame = {header.position};
    addMesh(channel, readMesh(in, header), source, options);
    WallFile wall = oneChannel(Profile::View, std::move(channel));
    if (in.left() > 0)
        remark(wall.remarks,
               source + ": byte " + std::to_string(in.at()) + ": " + std::to_string(in.left()) +
                   " bytes behind the mesh are passed over: compare the picture with the "
                   "producer's");
    return wall;
}

}  // namespace aquarama::formats
