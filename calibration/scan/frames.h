// SPDX-License-Identifier: Apache-2.0
// Reads the pictures of one camera as linear luminance, and keeps a small copy of each.
#pragma once

#include <future>
#include <optional>
#include <vector>

#include "calibration/scan/pictures.h"
#include "common/base/worker_pool.h"

namespace aquarama::scan {

// Values for each pixel of a camera, top row first.
using Plane = std::vector<float>;

// The light of a camera's pixel as one number: green counts as much as red and blue together, as
// most of a camera's sensors are green. This is not Rec. 709: cameras have primaries of their own.
[[nodiscard]] constexpr float cameraLuminance(float red, float green, float blue) {
    return 0.25F * red + 0.5F * green + 0.25F * blue;
}

// The linear light of every code.
[[nodiscard]] std::vector<float> lightOfCodes(int bits, config::ScanCamera::Response response);

// Calls work(first, last) for pieces of some thousand pixels, on all threads of the pool.
template <class Work>
void forPixels(WorkerPool& pool, std::size_t pixels, const Work& work) {
    constexpr std::size_t kPiece = 16384;
    pool.run((pixels + kPiece - 1) / kPiece, [&](std::size_t piece) {
        work(piece * kPiece, std::min(pixels, (piece + 1) * kPiece));
    });
}

// A small copy of a picture, by the mean of blocks of pixels: fine enough for the cells of a tag.
struct SmallPicture {
    std::size_t index = 0;  // in the scan
    Plane light;
};
// The small copies of all pictures of a camera.
struct SmallPictures {
    glm::ivec2 sizePixels{};
    int factor = 1;  // camera pixels along the side of a block
    std::vector<SmallPicture> pictures;

    // The picture of a smaller width.
    [[nodiscard]] Plane shrunk(const Plane& full, int fullWidth) const;
    // The copy of the picture of this index in the scan; null without one.
    [[nodiscard]] const Plane* of(std::size_t index) const;
};

// A picture as it was taken, and its luminance, scaled to the exposure of the first picture.
struct ScanFrame {
    std::size_t index = 0;  // in the scan
    const config::ScanPattern* pattern = nullptr;
    Picture picture;
    Plane luminance;
};

// Reads pictures in a given order, the next one on a second thread. Keeps a small copy of each.
class FrameReader {
  public:
    FrameReader(PictureSource& source, std::uint32_t camera, WorkerPool& pool);
    // Throws Error as the source does.
    [[nodiscard]] ScanFrame read(std::size_t index, std::optional<std::size_t> next);
    [[nodiscard]] glm::ivec2 sizePixels() const { return size_; }
    [[nodiscard]] SmallPictures& small() { return small_; }
    // The factor from the exposure of a picture to that of the first one.
    [[nodiscard]] float exposureScale(std::size_t index) const;

  private:
    void measure(ScanFrame& frame);

    PictureSource& source_;
    config::ScanCamera camera_;
    WorkerPool& pool_;
    std::optional<double> exposure_;
    glm::ivec2 size_{};
    std::vector<float> table_;
    int tableBits_ = 0;
    std::size_t aheadIndex_ = 0;
    std::future<Picture> ahead_;  // last: it uses the source until it is destroyed
    SmallPictures small_;
};

}  // namespace aquarama::scan
