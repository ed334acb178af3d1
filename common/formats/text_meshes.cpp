// SPDX-License-Identifier: Apache-2.0
// Reads meshes in text: Scalable ol, domeprojection csv with its frustum csv, Paul Bourke.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <span>

#include <glm/common.hpp>
#include <glm/gtc/type_precision.hpp>
#include <glm/trigonometric.hpp>

#include "common/base/log.h"
#include "common/formats/archive.h"
#include "common/formats/vendors.h"

namespace aquarama::formats {

namespace {

// The number of bytes that show the format of a file.
constexpr std::size_t kTelling = 256;

std::string_view firstLine(std::span<const std::byte> bytes) {
    std::string_view text = beginning(bytes, kTelling);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return text.substr(0, text.find_first_of("\r\n"));
}

}  // namespace

// domeprojection: the first line names the columns; others may follow.

namespace {

// A table of numbers with semicolons, read line by line.
class CsvTable {
  public:
    CsvTable(std::span<const std::byte> bytes, const std::string& source) : lines_(bytes, source) {
        if (!lines_.next()) lines_.fail("the file is empty; export it anew");
        for (const std::string_view field : lines_.fields(';')) {
            names_.emplace_back(field);
            for (char& letter : names_.back())
                letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
        }
    }
    [[nodiscard]] bool has(const char* name) const {
        return std::ranges::find(names_, name) != names_.end();
    }
    bool next() {
        if (!lines_.next()) return false;
        fields_ = lines_.fields(';');
        if (fields_.size() < names_.size())
            lines_.fail("has " + std::to_string(fields_.size()) + " values, not " +
                        std::to_string(names_.size()) + "; export the file anew");
        return true;
    }
    [[nodiscard]] double number(const char* name) const { return lines_.number(field(name)); }
    [[nodiscard]] std::uint32_t index(const char* name) const {
        return lines_.integer(field(name), kMostVertices);
    }
    [[noreturn]] void fail(const std::string& why) const { lines_.fail(why); }
    // The columns with other names than these.
    void remarkOthers(std::span<const std::string_view> known,
                      const std::string& source,
                      std::vector<std::string>& remarks) const {
        for (const std::string& name : names_)
            if (!name.empty() && std::ranges::find(known, name) == known.end())
                remark(remarks,
                       source + ":1: column \"" + printable(name) +
                           "\" is passed over: export what it says of the picture as MPCDI");
    }

  private:
    [[nodiscard]] std::string_view field(const char* name) const {
        const auto found = std::ranges::find(names_, name);
        if (found == names_.end())
            fail("the table has no column \"" + std::string(name) + "\"; export it anew");
        return fields_[static_cast<std::size_t>(found - names_.begin())];
    }
    VendorLines lines_;
    std::vector<std::string> names_;
    std::vector<std::string_view> fields_;
};

// The edges in one direction as angles from the axis. `sign`: of the low one in the file.
struct EdgePair {
    double low = 0, high = 0;
};

EdgePair edgesOf(const CsvTable& table, const char* low, const char* high, double sign) {
    const EdgePair degrees{sign * table.number(low), table.number(high)};
    if (std::max(std::abs(degrees.low), std::abs(degrees.high)) > kWidestEdgeDegrees ||
        degrees.low >= degrees.high)
        table.fail(std::string(low) + " and " + high + " enclose no picture; export it anew");
    return {glm::radians(degrees.low), glm::radians(degrees.high)};
}

// Files give left and bottom as angles away from the middle; where left is negative, with signs.
// Degrees in the file, radians here.
Frustum frustumOf(const CsvTable& table) {
    const double sign = table.number("left") < 0 ? 1 : -1;
    const EdgePair across = edgesOf(table, "left", "right", sign);
    const EdgePair along = edgesOf(table, "bottom", "top", sign);
    return {glm::radians(table.number("heading")),
            glm::radians(table.number("pitch")),
            glm::radians(table.number("bank")),
            across.low,
            across.high,
            along.low,
            along.high};
}

// z is up and y points ahead.
CoordinateFrame frameOf(const CsvTable& table) {
    return {{table.number("x"), table.number("y"), table.number("z")},
            {0, 0, -1},
            {1, 0, 0},
            {0, 1, 0}};
}

struct GridVertex {
    std::uint32_t column = 0, row = 0;
    WarpMesh::Vertex vertex{};
};

// The vertices, in the order of the file; each row of the table is one.
std::vector<GridVertex> gridVertices(CsvTable& table) {
    std::vector<GridVertex> vertices;
    while (table.next()) {
        if (vertices.size() == kMostVertices) table.fail("has too many vertices; export fewer");
        vertices.push_back(
            {table.index("column"),
             table.index("row"),
             {{table.number("x"), table.number("y")}, {table.number("u"), table.number("v"), 0}}});
    }
    return vertices;
}

// Columns and rows.
glm::u64vec2 gridSize(const std::vector<GridVertex>& vertices, const CsvTable& table) {
    glm::u64vec2 size(0);
    for (const GridVertex& vertex : vertices)
        size = glm::max(size, glm::u64vec2(vertex.column, vertex.row) + std::uint64_t{1});
    if (size.x < 2 || size.y < 2) table.fail("the mesh has no cell; export it anew");
    if (size.x * size.y != vertices.size())
        table.fail("the mesh of " + std::to_string(size.x) + " by " + std::to_string(size.y) +
                   " has " + std::to_string(vertices.size()) + " vertices; export it anew");
    return size;
}

// Puts the vertices in rows; each must occur once.
WarpMesh meshOf(const std::vector<GridVertex>& vertices, const CsvTable& table) {
    const glm::u64vec2 size = gridSize(vertices, table);
    WarpMesh mesh{std::vector<WarpMesh::Vertex>(vertices.size()), gridTriangles(size.x, size.y)};
    std::vector<bool> filled(vertices.size());
    for (const GridVertex& vertex : vertices) {
        const std::size_t i = vertex.row * size.x + vertex.column;
        if (filled[i]) table.fail("the mesh has a vertex twice; export it anew");
        filled[i] = true;
        mesh.vertices[i] = vertex.vertex;
    }
    return mesh;
}

}  // namespace

bool addFrustum(FileChannel& channel, const FrustumFile& file) {
    if (file.bytes.empty()) return false;
    CsvTable table(file.bytes, file.source);
    if (!table.next()) table.fail("the frustum's line is missing; export it anew");
    channel.frustum = frustumOf(table);
    channel.coordinateFrame = frameOf(table);
    return true;
}

bool isDomeprojection(std::span<const std::byte> bytes) {
    return firstLine(bytes).starts_with("x;y;");
}

WarpMesh domeprojectionMesh(std::span<const std::byte> bytes, const std::string& source) {
    CsvTable table(bytes, source);
    return meshOf(gridVertices(table), table);
}

WallFile readDomeprojection(std::span<const std::byte> bytes,
                            const std::string& source,
                            const ReadOptions& options,
                            const FrustumFile& frustum) {
    FileChannel channel;
    channel.name = stemOf(source);
    if (CsvTable(bytes, source).has("heading")) {
        addFrustum(channel, {source, bytes});
        channel.sizePixels = options.sizePixels.value_or(glm::ivec2(0));
        return oneChannel(Profile::View, std::move(channel));
    }
    const Profile profile = addFrustum(channel, frustum) ? Profile::View : Profile::Content;
    addMesh(channel, domeprojectionMesh(bytes, source), source, options);
    WallFile wall = oneChannel(profile, std::move(channel));
    constexpr std::array<std::string_view, 6> kColumns{"x", "y", "u", "v", "column", "row"};
    CsvTable(bytes, source).remarkOthers(kColumns, source, wall.remarks);
    return wall;
}

// Paul Bourke: x over the picture's aspect and y upward, -1 to 1; u and v from the bottom left.

namespace {

// Two columns of a polar mesh are neighbours: the first and the last.
constexpr std::uint32_t kPolar = 1, kRectangular = 2;
// Marks a vertex that is not shown.
constexpr double kHidden = std::numeric_limits<double>::quiet_NaN();

struct BourkeMesh {
    std::uint32_t type = 0, columns = 0, rows = 0;
    WarpMesh mesh;
};

// Reads the type, then columns and rows. Throws Error for sizes that no mesh has.
void readBourkeHeader(VendorLines& lines, BourkeMesh& read) {
    lines.next();
    read.type = lines.integer(lines.line(), 1000);
    lines.next();
    const auto counts = lines.fields(' ');
    if (counts.size() != 2) lines.fail("needs the numbers of columns and rows; copy it anew");
    read.columns = lines.integer(counts[0], kMostVertices);
    read.rows = lines.integer(counts[1], kMostVertices);
    if (std::min(read.columns, read.rows) < 2 ||
        std::uint64_t{read.columns} * read.rows > kMostVertices)
        lines.fail("no mesh has " + std::to_string(read.columns) + " by " +
                   std::to_string(read.rows) + " vertices; copy it anew");
}

// Reads all vertices, row by row; a light below zero hides a vertex.
void readBourkeVertices(VendorLines& lines, BourkeMesh& read) {
    const std::size_t count = std::size_t{read.columns} * read.rows;
    while (lines.next()) {
        const auto fields = lines.fields(' ');
        if (fields.size() != 5) lines.fail("needs the five numbers x y u v i; copy the file anew");
        if (read.mesh.vertices.size() == count) lines.fail("is one vertex too many; copy it anew");
        const double light = lines.number(fields[4]);
        read.mesh.vertices.push_back({{lines.number(fields[0]), lines.number(fields[1])},
                                      {lines.number(fields[2]), 1 - lines.number(fields[3]), 0},
                                      light});
        if (light < 0) read.mesh.vertices.back().target.x = kHidden;
    }
    if (read.mesh.vertices.size() != count)
        lines.fail("the mesh ends with " + std::to_string(read.mesh.vertices.size()) + " of " +
                   std::to_string(count) + " vertices; copy it anew");
}

// Half the picture's width, in units in which its height is 2.
double aspectOf(const WarpMesh& mesh, const ReadOptions& options) {
    if (options.sizePixels && pictureSize(options.sizePixels->x, options.sizePixels->y))
        return static_cast<double>(options.sizePixels->x) / options.sizePixels->y;
    double widest = 0;
    for (const WarpMesh::Vertex& vertex : mesh.vertices)
        widest = std::max(widest, std::abs(vertex.place.x));
    return widest > 0 ? widest : 1;
}

// The cells whose four vertices are all shown.
void addBourkeTriangles(BourkeMesh& read) {
    auto triangles = gridTriangles(read.columns, read.rows);
    for (std::uint32_t row = 0; read.type == kPolar && row + 1 < read.rows; ++row) {
        const std::uint32_t first = row * read.columns, last = first + read.columns - 1;
        triangles.push_back({last, first, first + read.columns});
        triangles.push_back({last, first + read.columns, last + read.columns});
    }
    for (std::size_t i = 0; i < triangles.size(); i += 2) {
        const auto shown = [&](std::uint32_t vertex) {
            return !std::isnan(read.mesh.vertices[vertex].target.x);
        };
        if (!std::ranges::all_of(triangles[i], shown) ||
            !std::ranges::all_of(triangles[i + 1], shown))
            continue;
        read.mesh.triangles.push_back(triangles[i]);
        read.mesh.triangles.push_back(triangles[i + 1]);
    }
}

}  // namespace

bool isPaulBourke(std::span<const std::byte> bytes) {
    const std::string source;
    VendorLines lines(bytes.first(std::min(bytes.size(), kTelling)), source);
    // Whether the next line has this many numbers.
    const auto hasNumbers = [&](std::size_t count) {
        lines.next();
        const auto fields = lines.fields(' ');
        const auto isNumber = [](std::string_view field) { return numberIn(field).has_value(); };
        return fields.size() == count && std::ranges::all_of(fields, isNumber);
    };
    return hasNumbers(1) && hasNumbers(2);
}

WallFile readPaulBourke(std::span<const std::byte> bytes,
                        const std::string& source,
                        const ReadOptions& options) {
    VendorLines lines(bytes, source);
    BourkeMesh read;
    readBourkeHeader(lines, read);
    readBourkeVertices(lines, read);
    const double aspect = aspectOf(read.mesh, options);
    for (WarpMesh::Vertex& vertex : read.mesh.vertices)
        vertex.place = {(vertex.place.x / aspect + 1) / 2, (1 - vertex.place.y) / 2};
    addBourkeTriangles(read);
    FileChannel channel;
    channel.name = stemOf(source);
    addMesh(channel, std::move(read.mesh), source, options, kCommonGamma);
    WallFile wall = oneChannel(Profile::Content, std::move(channel));
    if (read.type != kPolar && read.type != kRectangular)
        remark(wall.remarks,
               source + ":1: mesh type " + std::to_string(read.type) +
                   " is taken as rectangular, for flat content: compare the picture with the "
                   "producer's");
    return wall;
}

// Scalable: x and y in pixels, y upward; s and t from the bottom left.

namespace {

// Keys and their numbers, then vertices and faces.
struct ScalableFile {
    std::vector<std::pair<std::string, double>> keys;
    std::uint32_t vertices = 0, faces = 0;
    bool isEven = false;  // DO_NO_WARP
    WarpMesh mesh;
    std::vector<std::string> remarks;

    // The last value of a key, as other readers take it.
    [[nodiscard]] std::optional<double> find(std::string_view key) const {
        const auto found = std::ranges::find_if(
            keys.rbegin(), keys.rend(), [&](const auto& entry) { return entry.first == key; });
        if (found == keys.rend()) return {};
        return found->second;
    }
    [[nodiscard]] double number(std::string_view key, double otherwise = 0) const {
        return find(key).value_or(otherwise);
    }
};

constexpr std::size_t kMostKeys = 1000;

void readScalableVertex(const VendorLines& lines,
                        const std::vector<std::string_view>& fields,
                        ScalableFile& file) {
    if (fields.size() != 5) lines.fail("needs the five numbers x y intensity s t; copy it anew");
    if (file.mesh.vertices.size() == file.vertices)
        lines.fail("is one vertex more than VERTICES says; copy the file anew");
    file.mesh.vertices.push_back({{lines.number(fields[0]), lines.number(fields[1])},
                                  {lines.number(fields[3]), 1 - lines.number(fields[4]), 0},
                                  lines.number(fields[2]) / 255});
}

// [ 0 1 2 ]
void readScalableFace(const VendorLines& lines,
                      const std::vector<std::string_view>& fields,
                      ScalableFile& file) {
    if (fields.size() != 5 || fields[4] != "]")
        lines.fail("needs a face such as [ 0 1 2 ]; copy the file anew");
    if (file.mesh.triangles.size() == file.faces)
        lines.fail("is one face more than FACES says; copy the file anew");
    if (file.vertices == 0) lines.fail("is a face without vertices; copy the file anew");
    std::array<std::uint32_t, 3> face{};
    for (std::size_t i = 0; i < 3; ++i) face[i] = lines.integer(fields[i + 1], file.vertices - 1);
    file.mesh.triangles.push_back(face);
}

// VERTICES or FACES, before which there were so many.
std::uint32_t scalableCount(const VendorLines& lines,
                            std::string_view value,
                            std::uint32_t before) {
    if (before > 0) lines.fail("is a second count of vertices or faces; export the file anew");
    return lines.integer(value, 2 * kMostVertices);
}

// Keys that are supported, that change no picture, or that another key switches.
constexpr std::array<std::string_view, 26> kQuietKeys{"OPENMESH",
                                                      "VERTICES",
                                                      "FACES",
                                                      "MAPPING",
                                                      "NATIVEXRES",
                                                      "NATIVEYRES",
                                                      "ORTHO_LEFT",
                                                      "ORTHO_RIGHT",
                                                      "ORTHO_TOP",
                                                      "ORTHO_BOTTOM",
                                                      "GAMMA",
                                                      "LABEL",
                                                      "SUBVERSION",
                                                      "PERSPECTIVE_LEFT",
                                                      "PERSPECTIVE_RIGHT",
                                                      "PERSPECTIVE_TOP",
                                                      "PERSPECTIVE_BOTTOM",
                                                      "PERSPECTIVE_ROLL",
                                                      "PERSPECTIVE_PITCH",
                                                      "PERSPECTIVE_YAW",
                                                      "FRUSTUM_EULER_YAW",
                                                      "FRUSTUM_EULER_PITCH",
                                                      "FRUSTUM_EULER_ROLL",
                                                      "PERSPECTIVE_XOFFSET",
                                                      "PERSPECTIVE_YOFFSET",
                                                      "PERSPECTIVE_ZOFFSET"};

// The remark for each key that is not supported, and what to do. Only DO_NO_WARP is supported.
constexpr std::array<std::pair<std::string_view, const char*>, 6> kSaidKeys{{
    {"APPLY_MASK",
     "its mask is a file of its own, which is not read: export MPCDI with an alphaMap, or draw it "
     "by "
     "aquarama adjust mask"},
    {"APPLY_BLACK_LEVEL",
     "its black level is a file of its own, which is not read: export MPCDI with a betaMap"},
    {"APPLY_COLOR",
     "its colours are a file of their own, which is not read: set the projectors alike, or measure "
     "them by aquarama calibrate"},
    {"USE_SPHERE_SAMPLE_COORDINATE_SYSTEM",
     "its samples are taken as those of a plane, so the picture may be turned: export it without"},
    {"FRUSTUM_EULER_ANGLES",
     "FRUSTUM_EULER_* do not turn the picture here: give the angles as PERSPECTIVE_YAW, _PITCH and "
     "_ROLL"},
    {"DO_NO_WARP", "nothing is warped, only its blend is taken: set it to 0 for the mesh's warp"},
}};

// Whether a value switches a key on: it is neither zero nor a word for off.
bool isOn(std::string_view value) {
    const std::string_view off[] = {"", "0", "OFF", "FALSE", "NO", "off", "false", "no"};
    return std::ranges::find(off, value) == std::end(off) && numberIn(value) != 0.0;
}

// Keys whose usual value is a word, with that word.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kUsualWords{
    {{"SAMPLING", "LINEAR"}, {"PROJECTION", "PERSPECTIVE"}}};

// Whether a key with this value needs no remark.
bool isQuiet(std::string_view key, std::string_view value) {
    const bool isUsual = std::ranges::find(kUsualWords, std::pair{key, value}) != kUsualWords.end();
    return isUsual || !isOn(value) || std::ranges::find(kQuietKeys, key) != kQuietKeys.end();
}

// Adds the remarks about keys that are switched on, and applies the supported one.
void heedSwitch(const VendorLines& lines,
                std::string_view key,
                std::string_view value,
                ScalableFile& file) {
    if (key == "DO_NO_WARP") file.isEven = isOn(value);
    if (isQuiet(key, value)) return;
    const auto* said = std::ranges::find(kSaidKeys, key, [](const auto& one) { return one.first; });
    const std::string what = printable(std::string(key) + " " + std::string(value)) + ": ";
    remark(file.remarks,
           lines.placed(what + (said != kSaidKeys.end()
                                    ? said->second
                                    : "is not known here and passed over: compare the picture with "
                                      "the producer's")));
}

void readScalableKey(const VendorLines& lines,
                     const std::vector<std::string_view>& fields,
                     ScalableFile& file) {
    const std::string_view key = fields[0], value = fields.size() > 1 ? fields[1] : "";
    if (key == "VERTICES") file.vertices = scalableCount(lines, value, file.vertices);
    if (key == "FACES") file.faces = scalableCount(lines, value, file.faces);
    if (key == "MAPPING" && value != "NORMALIZED")
        lines.fail("its mapping is not NORMALIZED; export it so");
    heedSwitch(lines, key, value, file);
    const std::optional<double> number = numberIn(value);
    if (number && file.keys.size() < kMostKeys) file.keys.emplace_back(key, *number);
}

void readScalableLine(const VendorLines& lines, ScalableFile& file) {
    const auto fields = lines.fields(' ');
    if (fields[0] == "[")
        readScalableFace(lines, fields, file);
    else if (numberIn(fields[0]))
        readScalableVertex(lines, fields, file);
    else
        readScalableKey(lines, fields, file);
}

// Reads the whole file. Throws Error where its counts are wrong.
ScalableFile scalableFile(VendorLines& lines) {
    ScalableFile file;
    while (lines.next()) readScalableLine(lines, file);
    if (file.faces == 0 || file.mesh.vertices.size() != file.vertices ||
        file.mesh.triangles.size() != file.faces)
        lines.fail("the mesh ends with " + std::to_string(file.mesh.vertices.size()) + " of " +
                   std::to_string(file.vertices) + " vertices and " +
                   std::to_string(file.mesh.triangles.size()) + " of " +
                   std::to_string(file.faces) + " faces; copy it anew");
    return file;
}

// Makes the part of the picture that ORTHO_* cuts out the whole picture.
void placeInPicture(ScalableFile& file, glm::ivec2 size, const VendorLines& lines) {
    const glm::dvec2 first(file.number("ORTHO_LEFT"), file.number("ORTHO_BOTTOM"));
    const glm::dvec2 span =
        glm::dvec2(file.number("ORTHO_RIGHT", 1), file.number("ORTHO_TOP", 1)) - first;
    if (span.x == 0 || span.y == 0) lines.fail("ORTHO_* enclose no picture; export it anew");
    for (WarpMesh::Vertex& vertex : file.mesh.vertices) {
        const glm::dvec2 place = (vertex.place / glm::dvec2(size) - first) / span;
        vertex.place = {place.x, 1 - place.y};
        if (file.isEven) vertex.target = {vertex.place, 0};
    }
}

// Rz(roll) Ry(yaw) Rx(pitch), as the one public reader turns it.
Frustum scalablePose(const ScalableFile& file) {
    const auto half = [&](const char* key) { return glm::radians(file.number(key)) / 2; };
    const double r = half("PERSPECTIVE_ROLL"), y = half("PERSPECTIVE_YAW");
    const double p = half("PERSPECTIVE_PITCH");
    const double sr = std::sin(r), cr = std::cos(r), sy = std::sin(y), cy = std::cos(y);
    const double sp = std::sin(p), cp = std::cos(p);
    return turned(cr * cy * sp - sr * sy * cp,
                  cr * sy * cp + sr * cy * sp,
                  sr * cy * cp - cr * sy * sp,
                  cr * cy * cp + sr * sy * sp);
}

// Sets the edges, which are signed angles; without any the mesh shows flat content.
std::optional<Frustum> scalableFrustum(const ScalableFile& file, const VendorLines& lines) {
    Frustum frustum = scalablePose(file);
    const std::array<std::pair<const char*, double*>, 4> edges{{
        {"PERSPECTIVE_LEFT", &frustum.left},
        {"PERSPECTIVE_RIGHT", &frustum.right},
        {"PERSPECTIVE_BOTTOM", &frustum.down},
        {"PERSPECTIVE_TOP", &frustum.up},
    }};
    for (const auto& [key, edge] : edges) {
        const std::optional<double> degrees = file.find(key);
        if (!degrees) return {};
        if (std::abs(*degrees) > kWidestEdgeDegrees)
            lines.fail(std::string(key) + " is more than 89.9 degrees; export it anew");
        *edge = glm::radians(*degrees);
    }
    if (frustum.left >= frustum.right || frustum.down >= frustum.up)
        lines.fail("PERSPECTIVE_LEFT to _BOTTOM enclose no picture; export it anew");
    return frustum;
}

}  // namespace

bool isScalable(std::span<const std::byte> bytes) {
    return firstLine(bytes).starts_with("OPENMESH");
}

WallFile readScalable(std::span<const std::byte> bytes,
                      const std::string& source,
                      const ReadOptions& options) {
    VendorLines lines(bytes, source);
    ScalableFile file = scalableFile(lines);
    const auto size = pictureSize(file.number("NATIVEXRES"), file.number("NATIVEYRES"));
    if (!size) lines.fail("NATIVEXRES and NATIVEYRES are no picture's size; export it anew");
    FileChannel channel;
    channel.name = stemOf(source);
    channel.sizePixels = *size;
    channel.frustum = scalableFrustum(file, lines);
    if (channel.frustum)
        channel.coordinateFrame = {{file.number("PERSPECTIVE_XOFFSET"),
                                    file.number("PERSPECTIVE_YOFFSET"),
                                    file.number("PERSPECTIVE_ZOFFSET")}};
    placeInPicture(file, *size, lines);
    const double gamma = file.number("GAMMA", kCommonGamma);
    if (gamma < 0.1 || gamma > 10) lines.fail("GAMMA is not from 0.1 to 10; correct it");
    const Profile profile = channel.frustum ? Profile::View : Profile::Content;
    addMesh(channel, std::move(file.mesh), source, options, gamma);
    WallFile wall = oneChannel(profile, std::move(channel));
    wall.remarks = std::move(file.remarks);
    return wall;
}

}  // namespace aquarama::formats
