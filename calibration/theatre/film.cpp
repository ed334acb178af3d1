// SPDX-License-Identifier: Apache-2.0
#include "calibration/theatre/film.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <vector>

#include <webp/encode.h>
#include <webp/mux.h>

#include "calibration/theatre/compose.h"
#include "calibration/theatre/snapshot.h"
#include "common/units/error.h"
#include "common/units/ids.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

constexpr float kQuality = 80.0F;  // of 100: no block is seen at the size of a window
constexpr int kEffort = 3;         // of 6

// An animated WebP, written when it is whole.
class Clip {
  public:
    explicit Clip(glm::ivec2 sizePixels) : size_{sizePixels} {
        WebPAnimEncoderOptions options;
        WebPAnimEncoderOptionsInit(&options);
        options.minimize_size = 0;
        encoder_.reset(WebPAnimEncoderNew(size_.x, size_.y, &options));
        if (!encoder_)
            throw Error("a clip cannot be made: no memory, or its pictures are too large");
    }

    void add(const Picture& picture, int atMilliseconds) {
        std::vector<std::uint8_t> rgb(picture.rgb.begin(), picture.rgb.end());
        WebPConfig config;
        WebPConfigInit(&config);
        config.quality = kQuality;
        config.method = kEffort;
        WebPPicture frame;
        WebPPictureInit(&frame);
        frame.use_argb = 1;
        frame.width = size_.x;
        frame.height = size_.y;
        const bool added = WebPPictureImportRGB(&frame, rgb.data(), 3 * size_.x) != 0 &&
                           WebPAnimEncoderAdd(encoder_.get(), &frame, atMilliseconds, &config) != 0;
        WebPPictureFree(&frame);
        if (!added)
            throw Error(std::string("a clip cannot be made: ") +
                        WebPAnimEncoderGetError(encoder_.get()));
    }

    void write(const std::string& path, int endMilliseconds) {
        WebPAnimEncoderAdd(encoder_.get(), nullptr, endMilliseconds, nullptr);
        WebPData data;
        WebPDataInit(&data);
        const bool assembled = WebPAnimEncoderAssemble(encoder_.get(), &data) != 0;
        std::ofstream file(path, std::ios::binary);
        file.write(reinterpret_cast<const char*>(data.bytes),
                   static_cast<std::streamsize>(data.size));
        WebPDataClear(&data);
        if (!assembled || !file)
            throw Error(path + " cannot be written; is there room on the disk?");
    }

  private:
    struct Delete {
        void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
    };
    glm::ivec2 size_;
    std::unique_ptr<WebPAnimEncoder, Delete> encoder_;
};

// The folders of the filmed frames, by frame number.
std::vector<std::pair<std::uint64_t, fs::path>> filmedFrames(const fs::path& film) {
    std::vector<std::pair<std::uint64_t, fs::path>> frames;
    if (!fs::is_directory(film))
        throw Error(film.string() + " is missing; run the show with --film-every");
    for (const auto& entry : fs::directory_iterator(film)) {
        const std::string name = entry.path().filename().string();
        const bool numbered = name.find_first_not_of("0123456789") == std::string::npos;
        if (numbered) frames.emplace_back(std::stoull(name), entry.path());
    }
    if (frames.empty())
        throw Error(film.string() + " holds no frames; run the show for more of them");
    std::ranges::sort(frames);
    return frames;
}

int millisecondsOf(std::uint64_t frame) {
    return static_cast<int>(1000.0 * static_cast<double>(frame) / kTicksPerSecond);
}

}  // namespace

void composeFilm(const Rig& rig, const std::string& folder) {
    const fs::path film = fs::path(folder) / "film";
    const auto frames = filmedFrames(film);
    const std::uint64_t first = frames.front().first;
    const std::uint64_t step = frames.size() > 1 ? frames[1].first - first : 1;
    Clip clip(rig.panoramaPixels);
    for (const auto& [frame, path] : frames) {
        const Light panorama = composePanorama(rig, readChannels(rig, path.string()));
        clip.add(pictureOf(panorama, 8, static_cast<std::uint32_t>(frame)),
                 millisecondsOf(frame - first));
    }
    clip.write(folder + "/clip.webp", millisecondsOf(frames.back().first - first + step));
    fs::remove_all(film);
}

}  // namespace aquarama
