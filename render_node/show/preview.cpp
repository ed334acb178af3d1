// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/preview.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include <sys/resource.h>
#include <turbojpeg.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/wire/messages.h"

namespace aquarama::show {

namespace {

constexpr net::Duration kBetweenPictures = std::chrono::milliseconds(200);
// An older request is dropped: its console has stopped looking.
constexpr net::Duration kPreviewPatience = std::chrono::seconds(1);
constexpr net::Duration kBetweenHellos = std::chrono::seconds(1);
constexpr std::size_t kMostQuestions = 4;

// Bytes of a picture of four codes a pixel.
std::size_t bytesOf(glm::ivec2 sizePixels) {
    return std::size_t{4} * static_cast<std::size_t>(sizePixels.x) *
           static_cast<std::size_t>(sizePixels.y);
}

}  // namespace

bool isBlack(const ReducedPicture& picture) {
    constexpr std::size_t kAlpha = 3, kCodes = 4;
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        if (i % kCodes != kAlpha && picture.rgba[i] > 1) return false;
    return true;
}

PictureReader::~PictureReader() {
    if (fence_ != nullptr) glDeleteSync(fence_);
}

// The GPU reduces the picture and copies it to a buffer; no thread waits for it.
void PictureReader::begin(const gl::Target& from, int widthPixels) {
    assert(!isBusy());
    const glm::ivec2 whole = from.sizePixels();
    const int width = std::clamp(widthPixels, 1, whole.x);
    const glm::ivec2 size{width, std::max(1, whole.y * width / whole.x)};
    if (!reduced_ || reduced_->sizePixels() != size) {
        reduced_.emplace(GL_RGBA8, size);
        pixels_ = gl::makeBuffer(bytesOf(size), "preview", GL_MAP_READ_BIT);
    }
    glBlitNamedFramebuffer(from.framebuffer(),
                           reduced_->framebuffer(),
                           0,
                           0,
                           whole.x,
                           whole.y,
                           0,
                           0,
                           size.x,
                           size.y,
                           GL_COLOR_BUFFER_BIT,
                           size == whole ? GL_NEAREST : GL_LINEAR);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, pixels_->name());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, reduced_->framebuffer());
    glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
}

// Where the buffer is lost there is no picture; the console asks for another.
std::optional<ReducedPicture> PictureReader::take() {
    if (!isBusy() || glClientWaitSync(fence_, 0, 0) == GL_TIMEOUT_EXPIRED) return std::nullopt;
    glDeleteSync(std::exchange(fence_, nullptr));
    ReducedPicture picture{reduced_->sizePixels(), {}};
    picture.rgba.resize(bytesOf(picture.sizePixels));
    const auto size = static_cast<GLsizeiptr>(picture.rgba.size());
    const void* mapped = glMapNamedBufferRange(pixels_->name(), 0, size, GL_MAP_READ_BIT);
    if (mapped == nullptr) return std::nullopt;
    std::memcpy(picture.rgba.data(), mapped, picture.rgba.size());
    glUnmapNamedBuffer(pixels_->name());
    return picture;
}

// A picture of a reef at quality 75 takes 18 kB; a packet may have 60.
std::string encodeJpeg(const ReducedPicture& picture) {
    const std::unique_ptr<void, int (*)(tjhandle)> encoder(tjInitCompress(), tjDestroy);
    const glm::ivec2 size = picture.sizePixels;
    for (int quality = 75; encoder && quality > 0; quality -= 25) {
        unsigned char* bytes = nullptr;
        unsigned long count = 0;
        const int failed = tjCompress2(encoder.get(),
                                       picture.rgba.data(),
                                       size.x,
                                       0,
                                       size.y,
                                       TJPF_RGBX,
                                       &bytes,
                                       &count,
                                       TJSAMP_420,
                                       quality,
                                       TJFLAG_BOTTOMUP);
        const std::unique_ptr<unsigned char, void (*)(unsigned char*)> owner(bytes, tjFree);
        if (failed != 0) break;
        if (count <= wire::kMostJpegBytes) return {reinterpret_cast<const char*>(bytes), count};
    }
    throw Error("a picture for the console cannot be encoded as JPEG of " +
                std::to_string(wire::kMostJpegBytes) + " bytes; ask for a smaller one");
}

WatcherLink::WatcherLink(std::string channel,
                         const std::string& watchAddress,
                         const std::optional<net::PeerKeys>& keys)
    : channel_{std::move(channel)},
      channels_{net::connectNode(watchAddress, {}, keys)},
      thread_{[this] { run(); }} {}

WatcherLink::~WatcherLink() {
    ended_ = true;
    channels_->wake();
    thread_.join();
}

// A picture that was being made when its look was replaced is lost, so the wait for it has a limit.
std::optional<int> WatcherLink::wantedWidth() {
    const std::lock_guard lock(mutex_);
    const net::Moment now = net::monotonicNow();
    const bool isMaking = beingMade_ != 0 && now - lastPicture_ < kPreviewPatience;
    if (!request_ || isMaking || now - lastPicture_ < kBetweenPictures) return std::nullopt;
    const auto [number, width] = *std::exchange(request_, {});
    if (now - requestedAt_ > kPreviewPatience) return std::nullopt;
    beingMade_ = number;
    lastPicture_ = now;
    return width;
}

// The link's thread encodes the picture.
void WatcherLink::put(Frame frame, ReducedPicture picture) {
    {
        const std::lock_guard lock(mutex_);
        taken_ = Taken{beingMade_, frame, std::move(picture)};
    }
    channels_->wake();
}

std::optional<FishQuestion> WatcherLink::nextQuestion() {
    const std::lock_guard lock(mutex_);
    if (questions_.empty()) return std::nullopt;
    const FishQuestion first = questions_.front();
    questions_.pop_front();
    return first;
}

// The link's thread sends the answer.
void WatcherLink::answer(const FishQuestion& question,
                         Frame frame,
                         std::optional<std::uint32_t> fish) {
    v1::Envelope message;
    v1::FishReply& reply = *message.mutable_fish_reply();
    reply.set_number(question.number);
    reply.set_frame(frame.value);
    if (fish) reply.set_fish(*fish);
    {
        const std::lock_guard lock(mutex_);
        answers_.push_back(wire::encode(0, std::move(message)));
    }
    channels_->wake();
}

// --- its thread

// Introduces itself every second, as the console may have been restarted.
void WatcherLink::run() {
    constexpr int kLowest = 19;
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kLowest);  // of this thread alone
    net::Moment lastHello{};
    while (!ended_) {
        while (const auto bytes = channels_->receiveControl()) hear(*bytes);
        const net::Moment now = net::monotonicNow();
        if (now - lastHello >= kBetweenHellos) {
            lastHello = now;
            v1::Envelope hello;
            hello.mutable_watch_hello()->set_channel(channel_);
            channels_->sendControl(wire::encode(0, std::move(hello)));
        }
        sayWhatIsThere();
        channels_->wait(kBetweenHellos / 2);
    }
}

// A newer request replaces an older one.
void WatcherLink::hear(const net::ByteVector& bytes) {
    const auto message = wire::decode(bytes);
    if (!message) return;
    const std::lock_guard lock(mutex_);
    if (message->has_picture_request()) {
        const v1::PictureRequest& request = message->picture_request();
        request_ = {request.number(), static_cast<int>(request.width_px())};
        requestedAt_ = net::monotonicNow();
    } else if (message->has_fish_request() && questions_.size() < kMostQuestions) {
        const v1::FishRequest& request = message->fish_request();
        questions_.push_back({request.number(), {request.frame()}, {request.x(), request.y()}});
    }
}

// Encodes on this thread, so that no frame waits for it.
void WatcherLink::sayWhatIsThere() {
    std::optional<Taken> taken;
    std::deque<wire::Packet> answers;
    {
        const std::lock_guard lock(mutex_);
        taken = std::exchange(taken_, {});
        answers = std::exchange(answers_, {});
    }
    for (const wire::Packet& packet : answers) channels_->sendControl(packet);
    if (!taken) return;
    try {
        v1::Envelope message;
        v1::FramePicture& picture = *message.mutable_frame_picture();
        picture.set_number(taken->number);
        picture.set_frame(taken->frame.value);
        picture.set_width_px(static_cast<std::uint32_t>(taken->picture.sizePixels.x));
        picture.set_height_px(static_cast<std::uint32_t>(taken->picture.sizePixels.y));
        picture.set_jpeg(encodeJpeg(taken->picture));
        channels_->sendControl(wire::encode(0, std::move(message)));
    } catch (const Error& problem) {
        logWarning("{}", problem.what());
    }
    const std::lock_guard lock(mutex_);
    beingMade_ = 0;
}

}  // namespace aquarama::show
