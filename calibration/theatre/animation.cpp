// SPDX-License-Identifier: Apache-2.0
// Animated WebP, which web pages and documents show like any picture.
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include <webp/encode.h>
#include <webp/mux.h>

#include "calibration/theatre/clip.h"
#include "common/units/log.h"
#include "common/units/units.h"

namespace aquarama::theatre {

namespace {

constexpr float kQuality = 80.0F;  // of 100: no block is seen at the size of a window
constexpr int kEffort = 3;         // of 6

class Animation final : public Clip {
  public:
    explicit Animation(const ClipFormat& format)
        : format_{format}, part_{format.path + ".part"}, file_{part_, std::ios::binary} {
        if (!file_) throw Error(format.path + " cannot be written; choose a folder that can be");
        WebPAnimEncoderOptions options;
        WebPAnimEncoderOptionsInit(&options);
        options.minimize_size = 0;
        encoder_.reset(WebPAnimEncoderNew(format.sizePixels.x, format.sizePixels.y, &options));
        if (!encoder_)
            throw Error("a clip cannot be made: no memory, or its pictures are too large");
    }
    ~Animation() override {
        std::error_code none;
        std::filesystem::remove(part_, none);
    }
    Animation(const Animation&) = delete;
    Animation& operator=(const Animation&) = delete;

    void add(const wall::Picture& picture, std::uint64_t tick) override {
        if (!first_) first_ = tick;
        last_ = tick;
        std::vector<std::uint8_t> rgb(picture.rgb.begin(), picture.rgb.end());
        WebPConfig config;
        WebPConfigInit(&config);
        config.quality = kQuality;
        config.method = kEffort;
        WebPPicture frame;
        WebPPictureInit(&frame);
        frame.use_argb = 1;
        frame.width = format_.sizePixels.x;
        frame.height = format_.sizePixels.y;
        const bool added =
            WebPPictureImportRGB(&frame, rgb.data(), 3 * frame.width) != 0 &&
            WebPAnimEncoderAdd(encoder_.get(), &frame, millisecondsOf(tick), &config) != 0;
        WebPPictureFree(&frame);
        if (!added)
            throw Error(std::string("a clip cannot be made: ") +
                        WebPAnimEncoderGetError(encoder_.get()));
    }

    void finish() override {
        const int end = millisecondsOf(last_ + static_cast<std::uint64_t>(format_.ticksBetween));
        WebPAnimEncoderAdd(encoder_.get(), nullptr, end, nullptr);
        WebPData data;
        WebPDataInit(&data);
        const bool assembled = WebPAnimEncoderAssemble(encoder_.get(), &data) != 0;
        file_.write(reinterpret_cast<const char*>(data.bytes),
                    static_cast<std::streamsize>(data.size));
        file_.close();
        WebPDataClear(&data);
        if (!assembled || !file_)
            throw Error(format_.path + " cannot be written; is there room on the disk?");
        std::filesystem::rename(part_, format_.path);
    }

  private:
    struct Delete {
        void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
    };
    [[nodiscard]] int millisecondsOf(std::uint64_t tick) const {
        return static_cast<int>(1000.0 * static_cast<double>(tick - *first_) / kTicksPerSecond);
    }

    ClipFormat format_;
    std::string part_;
    std::ofstream file_;
    std::unique_ptr<WebPAnimEncoder, Delete> encoder_;
    std::optional<std::uint64_t> first_;
    std::uint64_t last_ = 0;
};

}  // namespace

std::unique_ptr<Clip> makeAnimation(const ClipFormat& format) {
    return std::make_unique<Animation>(format);
}

}  // namespace aquarama::theatre
