// SPDX-License-Identifier: Apache-2.0
// Readers of the warp files of other vendors. Which format a file has is told by its first bytes;
// what each format means, and what of it is verified, is in docs/wall_files.md. Files are
// untrusted: every reader throws Error with one line that says what, where and what to do.
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

// A file beside another that says where a channel is seen from (x;y;z;heading;...); no bytes where
// there is none.
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
// points are the screen's.
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
// Polygons become fans. A point is there once for each texture coordinate that faces give it.
[[nodiscard]] TriangleMesh readObj(std::span<const std::byte> bytes, const std::string& source);

// The meshes as they stand in files, before they are rasterised.
[[nodiscard]] WarpMesh simcadMesh(std::span<const std::byte> bytes, const std::string& source);
[[nodiscard]] WarpMesh domeprojectionMesh(std::span<const std::byte> bytes,
                                          const std::string& source);
[[nodiscard]] WarpMesh scissMesh(std::span<const std::byte> bytes, const std::string& source);

// Warns of each of these, once in a process: a wall may be made of the same files several times.
void sayRemarks(const std::vector<std::string>& remarks);

// What these readers share.

// The most that a file may have: vertices or samples; pixels each way and in all of a picture.
inline constexpr std::size_t kMostVertices = std::size_t{1} << 22;
inline constexpr std::size_t kMostPictureSide = 16384;
inline constexpr std::size_t kMostPicturePixels = std::size_t{1} << 25;
// The exponent of blends whose factor multiplies encoded colours, where the file names none.
inline constexpr double kCommonGamma = 2.2;

// A picture's size of these numbers, if it can be one.
[[nodiscard]] std::optional<glm::ivec2> pictureSize(double width, double height);
// The name of a channel whose file gives none: the file's, without folder and ending.
[[nodiscard]] std::string stemOf(const std::string& path);
// Yaw, pitch and roll of a unit quaternion that turns camera axes into those of the world.
[[nodiscard]] Frustum turned(double x, double y, double z, double w);
[[nodiscard]] WallFile oneChannel(Profile profile, FileChannel channel);
// Adds pose, edges and position of a frustum file where there is one; true then.
bool addFrustum(FileChannel& channel, const FrustumFile& file);

// Two triangles for each cell of a grid of vertices that stand row by row.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> gridTriangles(std::size_t columns,
                                                                      std::size_t rows);
// The mesh as the channel's warp: its own nodes where they lie evenly from border to border, else
// rasterised at the picture's size, which the channel or the user must know. With `lightGamma` the
// vertices' light becomes the blend, and multiplies colours that are encoded so.
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
// A text that is no number, quoted, with the number that it is meant as where that can be told.
[[nodiscard]] std::string quotedNumber(std::string_view text);
// The number in a text, as above.
[[nodiscard]] std::optional<double> numberIn(std::string_view text);
// At most this many of the first bytes, as text.
[[nodiscard]] std::string_view beginning(std::span<const std::byte> bytes, std::size_t most);

// A binary file, little endian, read from front to back.
class VendorBytes {
  public:
    // Both must outlive this.
    VendorBytes(std::span<const std::byte> bytes, const std::string& source)
        : source_(source), bytes_(bytes) {}
    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
    // Goes there. A place beyond the end is an error.
    void go(std::size_t byte);
    [[nodiscard]] std::uint32_t u32();
    [[nodiscard]] std::uint16_t u16();
    [[nodiscard]] std::uint8_t u8();
    // Any bits, also of a NaN.
    [[nodiscard]] float f32();
    // A finite number of at most 1e9, positive or negative.
    [[nodiscard]] double number();
    // Refuses the file unless so many parts of so many bytes follow.
    void need(std::uint64_t count, std::uint64_t bytesEach, const char* what) const;
    [[noreturn]] void fail(const std::string& why) const;

  private:
    const std::string& source_;
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

}  // namespace aquarama::formats
