// SPDX-License-Identifier: Apache-2.0
// Reads the warp files of other vendors. The first bytes of a file show its format;
// docs/wall_files.md describes each format and what of it is verified. Files are untrusted: every
// reader throws Error with one line that says what, where and what to do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/formats/wall_file.h"

namespace aquarama::formats {

// A frustum file beside a warp file: the pose of a channel (x;y;z;heading;...). No bytes without
// one.
struct FrustumFile {
    std::string source;
    std::span<const std::byte> bytes;
};
// The path that it has: "channel1_warp_frustum.csv" beside "channel1_warp.simcad",
// "channel1_warp.pfm" and "channel1_warp_mesh.csv".
[[nodiscard]] std::string frustumPathBeside(const std::string& path);

// VIOSO vwf: all channels, with blend and black level.
[[nodiscard]] bool isVioso(std::span<const std::byte> bytes);
[[nodiscard]] WallFile readVioso(std::span<const std::byte> bytes,
                                 const std::string& source,
                                 const ReadOptions& options);

// SCISS sgc, versions 1 and 2, planar.
[[nodiscard]] bool isSciss(std::span<const std::byte> bytes);
[[nodiscard]] WallFile readSciss(std::span<const std::byte> bytes,
                                 const std::string& source,
                                 const ReadOptions& options);

// Scalable ol (OPENMESH 1.1).
[[nodiscard]] bool isScalable(std::span<const std::byte> bytes);
[[nodiscard]] WallFile readScalable(std::span<const std::byte> bytes,
                                    const std::string& source,
                                    const ReadOptions& options);

// domeprojection csv: a mesh, or a frustum file alone, which makes a channel without a warp.
[[nodiscard]] bool isDomeprojection(std::span<const std::byte> bytes);
[[nodiscard]] WallFile readDomeprojection(std::span<const std::byte> bytes,
                                          const std::string& source,
                                          const ReadOptions& options,
                                          const FrustumFile& frustum = {});

// Barco SimCAD xml.
[[nodiscard]] bool isSimcad(std::span<const std::byte> bytes);
[[nodiscard]] WallFile readSimcad(std::span<const std::byte> bytes,
                                  const std::string& source,
                                  const ReadOptions& options,
                                  const FrustumFile& frustum = {});

// Paul Bourke's mesh as text.
[[nodiscard]] bool isPaulBourke(std::span<const std::byte> bytes);
[[nodiscard]] WallFile readPaulBourke(std::span<const std::byte> bytes,
                                      const std::string& source,
                                      const ReadOptions& options);

// Wavefront obj. As a wall file it needs texture coordinates, which are places of the picture; its
// points are points of the screen.
[[nodiscard]] bool isObj(std::span<const std::byte> bytes);
[[nodiscard]] WallFile readObjWarp(std::span<const std::byte> bytes,
                                   const std::string& source,
                                   const ReadOptions& options);

// A surface in space, such as a measured screen.
struct TriangleMesh {
    std::vector<glm::dvec3> points;    // metres
    std::vector<glm::dvec2> textures;  // one for each point, from the bottom left; or none at all
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::string> remarks = {};  // as WallFile has them
};
// Polygons become fans of triangles. A point is repeated for each texture coordinate that faces
// give it.
[[nodiscard]] TriangleMesh readObj(std::span<const std::byte> bytes, const std::string& source);

// The meshes of files before they are rasterised.
[[nodiscard]] WarpMesh simcadMesh(std::span<const std::byte> bytes, const std::string& source);
[[nodiscard]] WarpMesh domeprojectionMesh(std::span<const std::byte> bytes,
                                          const std::string& source);
[[nodiscard]] WarpMesh scissMesh(std::span<const std::byte> bytes, const std::string& source);

// Logs each remark as a warning, once in a process: a wall may be made from the same files several
// times.
void sayRemarks(const std::vector<std::string>& remarks);

// What these readers share.

// Limits of a file: vertices or samples; pixels of a picture each way and in all.
inline constexpr std::size_t kMostVertices = std::size_t{1} << 22;
inline constexpr std::size_t kMostPictureSide = 16384;
inline constexpr std::size_t kMostPicturePixels = std::size_t{1} << 25;
// The exponent of blends whose factor multiplies encoded colours, where the file names none.
inline constexpr double kCommonGamma = 2.2;
// The widest angle between the middle of a picture and its edge on a plane.
inline constexpr double kWidestEdgeDegrees = 89.9;

// The size of a picture, if these numbers can be one.
[[nodiscard]] std::optional<glm::ivec2> pictureSize(double width, double height);
// The name of a channel whose file gives none: the file's, without folder and ending.
[[nodiscard]] std::string stemOf(const std::string& path);
// Yaw, pitch and roll of a unit quaternion that turns camera axes into those of the world.
[[nodiscard]] Frustum turned(double x, double y, double z, double w);
[[nodiscard]] WallFile oneChannel(Profile profile, FileChannel channel);
// Adds pose, edges and position of a frustum file where there is one; true then.
bool addFrustum(FileChannel& channel, const FrustumFile& file);

// Two triangles for each cell of a grid of vertices, row by row.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> gridTriangles(std::size_t columns,
                                                                      std::size_t rows);
// Sets the mesh as the channel's warp: its own nodes where they are even from border to border;
// else rasterised at the picture's size, which the channel or the user must give. With `lightGamma`
// the light of the vertices becomes the blend; it multiplies colours with this gamma.
void addMesh(FileChannel& channel,
             WarpMesh mesh,
             const std::string& source,
             const ReadOptions& options,
             std::optional<double> lightGamma = {});

// The lines of a text file that are not blank, one after another.
class VendorLines {
  public:
    // Any ends of lines; a byte order mark is skipped. Both must outlive this. `joined`: whether a
    // line that begins with such a word and ends with a backslash goes on in the next.
    VendorLines(std::span<const std::byte> bytes,
                const std::string& source,
                bool (*joined)(std::string_view word) = nullptr);
    // False at the end of the file.
    bool next();
    [[nodiscard]] std::string_view line() const { return line_; }
    // The parts of the line between these separators; blanks around them are dropped.
    [[nodiscard]] std::vector<std::string_view> fields(char separator) const;
    // A finite number of at most 1e9, positive or negative; an integer within bounds.
    [[nodiscard]] double number(std::string_view field) const;
    [[nodiscard]] std::uint32_t integer(std::string_view field, std::uint32_t most) const;
    [[noreturn]] void fail(const std::string& why) const;
    // "source:line: what", for a remark.
    [[nodiscard]] std::string placed(const std::string& what) const;

  private:
    // Up to the next end of a line, which is passed.
    std::string_view takeLine();
    void joinLines();

    const std::string& source_;
    std::string_view rest_, line_;
    bool (*joined_)(std::string_view word);
    std::string joinedLine_;  // what line_ is a part of, where lines were joined
    int lineNumber_ = 0;      // of the line, or the first of those that were joined
    int linesTaken_ = 0;
};
// A text that is no number, quoted, with the number that it seems to mean.
[[nodiscard]] std::string quotedNumber(std::string_view text);
// The number in a text, as above.
[[nodiscard]] std::optional<double> numberIn(std::string_view text);
// The first bytes as text, at most this many.
[[nodiscard]] std::string_view beginning(std::span<const std::byte> bytes, std::size_t most);

// A binary file, little endian, read from front to back.
class VendorBytes {
  public:
    // Both must outlive this.
    VendorBytes(std::span<const std::byte> bytes, const std::string& source)
        : source_(source), bytes_(bytes) {}
    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
    // Moves to an offset. An offset beyond the end is an error.
    void go(std::size_t byte);
    [[nodiscard]] std::uint32_t u32();
    [[nodiscard]] std::uint16_t u16();
    [[nodiscard]] std::uint8_t u8();
    // Any bits, also of a NaN.
    [[nodiscard]] float f32();
    // A finite number of at most 1e9, positive or negative.
    [[nodiscard]] double number();
    // Refuses the file unless this many parts of this size follow.
    void need(std::uint64_t count, std::uint64_t bytesEach, const char* what) const;
    [[noreturn]] void fail(const std::string& why) const;

  private:
    const std::string& source_;
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

}  // namespace aquarama::formats
