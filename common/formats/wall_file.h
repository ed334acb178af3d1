// SPDX-License-Identifier: Apache-2.0
// A wall file: warp, blend, black level and pose of the channels of a wall, read from any known
// format. Files are untrusted: every reader checks sizes before it allocates, and throws Error with
// one line that says what, where and what to do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aquarama::formats {

// The meaning of the samples of all warps of a file; named as the profiles of MPCDI.
enum class Profile : std::uint8_t {
    Content,    // "2d": a place in flat content, the same for all channels: x right, y down, 0 to 1
    View,       // "3d": a place in the picture of the channel's frustum: x right, y down, 0 to 1
    Screen,     // "a3": the point of the screen that is lit, metres
    Projector,  // "sl": as View; frustum and position are those of the projector itself
};

// The places of a warp's samples in the projector's picture: sample c of n is at (c + 0.5) / n of
// its width, or from border to border at c / (n - 1). The same for rows.
enum class Sampling : std::uint8_t { Centres, Nodes };

// The way in which a file stores the samples of a warp. They are written in the same way, as floats
// would not stay exact in another. Samples in memory always have the meaning of Profile.
enum class Stored : std::uint8_t {
    Places,       // of the channel's part of the buffer (Content), of the picture, of the world
    WholeBuffer,  // of the whole buffer (Content)
    Offsets,      // from an even grid (View, Projector)
};

// The x of a sample that shows nothing.
inline constexpr float kUnlit = std::numeric_limits<float>::quiet_NaN();

// The warp of a channel: what each place of the projector's picture shows (Profile), top row first.
// x is NaN where a place shows nothing.
struct Warp {
    glm::ivec2 size{};  // samples
    Sampling sampling = Sampling::Centres;
    std::vector<glm::vec3> samples;
    Stored stored = Stored::Places;
    // The texels of a float map that was read, in the order of the samples. They are written again
    // exactly, where the sample is unchanged.
    std::vector<glm::vec3> texels = {};
};

// A mask over the projector's picture, top row first; its size may differ from the picture's.
// code / most of its bits, to the power of gamma, is linear.
struct Mask {
    glm::ivec2 size{};
    int components = 1;  // 1, or 3: red green blue
    int bits = 8;        // 8 or 16
    double gamma = 1;
    std::vector<std::uint16_t> codes;
};

// The pose from which a picture is seen or projected, and its edges. Canonical axes: x right, y up,
// -z forward; camera_to_world = Ry(-yaw) Rx(pitch) Rz(-roll). Radians; edges are angles from the
// optical axis, left and down negative.
struct Frustum {
    double yaw = 0, pitch = 0, roll = 0;
    double left = 0, right = 0, down = 0, up = 0;
};
// camera_to_world of its yaw, pitch and roll.
[[nodiscard]] glm::dmat3 worldFromCamera(const Frustum& frustum);

// The axes in which a file gives a projector's position, as vectors of canonical axes.
struct CoordinateFrame {
    glm::dvec3 position{};  // in the file's axes
    glm::dvec3 yaw{0, -1, 0}, pitch{1, 0, 0},
        roll{0, 0, -1};  // where down, right and forward point
    // p_canonical = (dot(p, pitch), -dot(p, yaw), -dot(p, roll)).
    [[nodiscard]] glm::dvec3 canonicalPosition() const;
};

// Unknown parts of a file, kept for a round trip: an element of XML, and files of the archive that
// it names.
struct Extension {
    std::string xml;
    std::vector<std::pair<std::string, std::vector<std::byte>>> files;
    std::string place = "extensionSet";  // the element that contains it
};

// The conversion to a projector's own red, green and blue, for walls whose projectors differ. After
// blend and black level: own = mix * linear Rec. 709, both 0 to 1. The projector is sent the codes
// whose light, by `response`, is own.
struct ChannelColour {
    glm::mat3 mix{1};
    // The light of codes at equal steps from 0 to 1, linear between them. It rises from 0 to 1 and
    // never falls.
    std::array<std::vector<float>, 3> response;
};
inline constexpr std::array<const char*, 3> kPrimaryNames{"red", "green", "blue"};
inline constexpr std::size_t kLeastResponses = 2, kMostResponses = 1024;
inline constexpr float kMostMix = 100;     // of each number, either way
inline constexpr float kLeastMix = 1e-9F;  // of its determinant: the light of codes can be told
// The fault of a colour, as the words after "has"; empty: none.
[[nodiscard]] std::string faultOf(const ChannelColour& colour);
// The least code (0 to 1) with at least this light; and the light of a code.
[[nodiscard]] double codeFor(std::span<const float> response, double light);
[[nodiscard]] double lightFor(std::span<const float> response, double code);

// One projector of a wall file.
struct FileChannel {
    std::string name;
    glm::ivec2 sizePixels{};
    std::string buffer = "buffer1";  // content that it shares with channels of the same buffer
    glm::ivec2 bufferPixels{};       // 0: not given
    // The part of the buffer that it takes: top left corner and size, 0 to 1.
    glm::dvec2 corner{0, 0}, extent{1, 1};
    std::optional<Frustum> frustum;
    std::optional<CoordinateFrame> coordinateFrame;
    std::optional<Warp> warp;
    std::optional<Warp> distortion;    // Projector: of the lens
    std::optional<Mask> blend, black;  // out = in * blend * (1 - black) + black, in linear light
    std::optional<ChannelColour> colour;
    std::string interpolation = "linear";  // between samples: also "keystone", "smooth"
    std::vector<Extension> extensions;     // of this channel
};

// Where the points of the screen are measured from (Screen, Projector).
enum class DataOrigin : std::uint8_t { Unknown, CentreOfMass, IdealEyePoint, FloorCentre };

// A whole file.
struct WallFile {
    Profile profile = Profile::Content;
    std::vector<FileChannel> channels;
    std::vector<Extension> extensions;
    DataOrigin origin = DataOrigin::Unknown;
    std::string date;  // as the file says it; where empty, that of writing
    // Requests of the file that are not supported, so that the picture may differ from the
    // producer's: a line each for the user, with the place in the file and what to do.
    std::vector<std::string> remarks = {};
};
inline constexpr std::size_t kMostRemarks = 16;
// Adds a remark, up to kMostRemarks.
void remark(std::vector<std::string>& remarks, const std::string& line);

// What a file does not say and the user may add.
struct ReadOptions {
    std::optional<glm::ivec2> sizePixels = {};  // of the projector's picture
    std::optional<Sampling> sampling = {};      // of coarse grids of formats that leave it open
    bool upsideDown = false;  // the producer's rows run the other way than the format says
};

// Reads a file of any known format, which its content shows, not its name. A frustum file beside a
// mesh or map is read as well. Throws Error.
[[nodiscard]] WallFile readWallFile(const std::string& path, const ReadOptions& options = {});
// The same from its bytes; `source` names it in errors. `frustum`: the bytes of the frustum file,
// if any.
[[nodiscard]] WallFile readWallFile(std::span<const std::byte> bytes,
                                    const std::string& source,
                                    const ReadOptions& options = {},
                                    std::span<const std::byte> frustum = {});

// The warp at a place of the picture (0 to 1, top left corner at (0, 0)), bilinear between samples
// and extrapolated beyond the outermost centres. x is NaN where a sample that is used is NaN.
[[nodiscard]] glm::vec3 warpAt(const Warp& warp, glm::dvec2 place);
// The linear light that a mask transmits at a place, bilinear between the centres of its codes;
// beyond them that of the border.
[[nodiscard]] glm::vec3 lightAt(const Mask& mask, glm::dvec2 place);
// lightAt() for many places: the linear light of each code is computed once. Immutable.
class MaskLight {
  public:
    // `mask` outlives it.
    explicit MaskLight(const Mask& mask);
    [[nodiscard]] glm::vec3 at(glm::dvec2 place) const;

  private:
    const Mask& mask_;
    std::vector<double> lightOfCode_;
};
// The same warp at the centres of a grid of samples, stored as places, for tools that read nothing
// else.
[[nodiscard]] Warp resampled(const Warp& warp, glm::ivec2 size);

// A mesh over a projector's picture, as in several formats.
struct WarpMesh {
    // A corner of the mesh.
    struct Vertex {
        glm::dvec2 place;   // of the picture, 0 to 1, top left corner at (0, 0)
        glm::dvec3 target;  // what it shows
        double light = 1;   // blend, linear
    };
    std::vector<Vertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};
// The mesh at the centres of a grid of samples, linear within triangles. `light`: receives the
// blend as a mask, unless null. Where triangles overlap, the later one counts.
[[nodiscard]] Warp rasterised(const WarpMesh& mesh, glm::ivec2 size, Mask* light = nullptr);

}  // namespace aquarama::formats
