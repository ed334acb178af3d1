// SPDX-License-Identifier: Apache-2.0
// Reads Barco SimCAD: an XML file of offsets of a square grid of nodes, top row first, as parts of
// a range, the projector's width or height in pixels.
#include <algorithm>
#include <array>
#include <cmath>

#include <pugixml.hpp>

#include "common/base/log.h"
#include "common/formats/archive.h"
#include "common/formats/vendors.h"

namespace aquarama::formats {

namespace {

constexpr std::size_t kTellingSimcad = 4096;
constexpr std::size_t kMostGridSide = 1025;  // of the grid

struct Offsets {
    double range = 0;
    std::vector<double> values;  // parts of the range
};

struct SimcadFile {
    Offsets x, y;
    std::size_t side = 0;
    std::vector<std::string> remarks = {};
};

[[noreturn]] void fail(const std::string& source, const char* element, const std::string& why) {
    throw Error(source + ": <" + element + ">: " + why);
}

std::vector<double> numbersOf(std::string_view text,
                              const char* element,
                              const std::string& source) {
    constexpr std::string_view kBlank = " \t\r\n";
    std::vector<double> numbers;
    for (std::size_t at = 0; (at = text.find_first_not_of(kBlank, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kBlank, at), text.size());
        const std::optional<double> value = numberIn(text.substr(at, end - at));
        if (!value || numbers.size() == kMostGridSide * kMostGridSide)
            fail(source,
                 element,
                 "value " + std::to_string(numbers.size() + 1) +
                     " is no number from -1e9 to 1e9, or one too many: " +
                     quotedNumber(text.substr(at, end - at)) + "; export it anew");
        numbers.push_back(*value);
        at = end;
    }
    return numbers;
}

// Reads the offsets of one direction. Throws Error where the element or its range is missing.
Offsets readOffsets(const pugi::xml_node& definition,
                    const char* element,
                    const std::string& source) {
    const pugi::xml_node node = definition.child(element);
    if (!node) fail(source, element, "is missing; export the file anew");
    Offsets offsets;
    offsets.range = numberIn(node.attribute("range").as_string()).value_or(0);
    if (offsets.range < 1) fail(source, element, "needs a range from 1 pixel; export it anew");
    offsets.values = numbersOf(node.child_value(), element, source);
    for (double& value : offsets.values) value /= offsets.range;
    return offsets;
}

// Elements of geometry or light that are not read.
void sayOthers(const pugi::xml_node& definition,
               const std::string& source,
               std::vector<std::string>& remarks) {
    for (const pugi::xml_node parent : {definition, definition.parent()})
        for (const pugi::xml_node node : parent.children()) {
            constexpr std::array<std::string_view, 3> kRead{
                "GeometryDefinition", "X-FlatParameters", "Y-FlatParameters"};
            const std::string_view name = node.name();
            const bool isRead = std::ranges::find(kRead, name) != kRead.end();
            if (node.type() == pugi::node_element && !isRead)
                remark(remarks,
                       source + ": <" + printable(name) +
                           "> is passed over: compare the picture with the producer's");
        }
}

SimcadFile simcadFile(std::span<const std::byte> bytes, const std::string& source) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
    if (!parsed)
        throw Error(source + ": byte " + std::to_string(parsed.offset) + ": is no whole XML (" +
                    parsed.description() + "); export it anew");
    const pugi::xml_node definition = document.child("GeometryFile").child("GeometryDefinition");
    if (!definition) fail(source, "GeometryDefinition", "is missing; export the file anew");
    SimcadFile file{readOffsets(definition, "X-FlatParameters", source),
                    readOffsets(definition, "Y-FlatParameters", source)};
    sayOthers(definition, source, file.remarks);
    const std::size_t count = file.x.values.size();
    file.side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(count))));
    if (file.side < 2 || file.side * file.side != count || file.y.values.size() != count)
        fail(source,
             "GeometryDefinition",
             "has " + std::to_string(count) + " offsets in x and " +
                 std::to_string(file.y.values.size()) + " in y, not those of a square grid");
    return file;
}

// The even grid is the content; the offsets are its places.
WarpMesh meshOf(const SimcadFile& file) {
    WarpMesh mesh{{}, gridTriangles(file.side, file.side)};
    const glm::dvec2 last(static_cast<double>(file.side - 1));
    for (std::size_t i = 0; i < file.x.values.size(); ++i) {
        const glm::dvec2 node = glm::dvec2(i % file.side, i / file.side) / last;
        const glm::dvec2 place = node + glm::dvec2(file.x.values[i], file.y.values[i]);
        mesh.vertices.push_back({place, {node, 0}});
    }
    return mesh;
}

}  // namespace

bool isSimcad(std::span<const std::byte> bytes) {
    return beginning(bytes, kTellingSimcad).find("<GeometryFile") != std::string_view::npos;
}

WarpMesh simcadMesh(std::span<const std::byte> bytes, const std::string& source) {
    return meshOf(simcadFile(bytes, source));
}

WallFile readSimcad(std::span<const std::byte> bytes,
                    const std::string& source,
                    const ReadOptions& options,
                    const FrustumFile& frustum) {
    const SimcadFile file = simcadFile(bytes, source);
    FileChannel channel;
    channel.name = stemOf(source);
    channel.sizePixels = pictureSize(file.x.range, file.y.range).value_or(glm::ivec2(0));
    const Profile profile = addFrustum(channel, frustum) ? Profile::View : Profile::Content;
    addMesh(channel, meshOf(file), source, options);
    WallFile wall = oneChannel(profile, std::move(channel));
    wall.remarks = file.remarks;
    return wall;
}

}  // namespace aquarama::formats
