// SPDX-License-Identifier: Apache-2.0
// Frames of a channel on their way to a clip: PUSH and PULL over a socket of the file system. Each
// end watches the connection, so that an end that dies never blocks the other. The last message is
// empty. The receiver then closes the connection: if the sender did, ZeroMQ would drop messages
// that the receiver has not read.
#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "common/base/log.h"
#include "common/net/sockets.h"

namespace aquarama::net {
namespace {

constexpr int kFrameQueue = 2;  // frames that wait at either end
constexpr std::size_t kMostFrameBytes = std::size_t{256} << 20U;
constexpr auto kPatience = std::chrono::seconds(30);    // for a receiver to come
constexpr auto kLastFrames = std::chrono::seconds(60);  // for it to take the frames in flight
constexpr std::chrono::milliseconds kBetweenLooks{100};

// Before the codes of each frame; both ends are on one machine.
struct FrameHeader {
    std::uint64_t frame = 0;
    std::int32_t width = 0, height = 0;
};

// Three codes a pixel; the header has been checked for negative sizes.
std::size_t codesIn(const FrameHeader& header) {
    return 3 * static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
}

std::string addressOf(const std::filesystem::path& path) {
    return "ipc://" + path.string();
}

void pollItems(std::span<zmq::pollitem_t> items, std::chrono::milliseconds atMost) {
    try {
        zmq::poll(items.data(), items.size(), atMost);
    } catch (const zmq::error_t&) {  // a signal: the caller looks around and waits again
    }
}

// Whether the one peer of a socket has come and gone, from the events of its connection.
class PeerWatch {
  public:
    PeerWatch(zmq::context_t& context, zmq::socket_t& watched)
        : events_(context, zmq::socket_type::pair) {
        constexpr const char* kAddress = "inproc://peer";
        zmq_socket_monitor(
            watched.handle(), kAddress, ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED);
        events_.connect(kAddress);
    }
    // The peer has connected, now or earlier.
    [[nodiscard]] bool hasCome() {
        readEvents();
        return come_;
    }
    // It has connected, and its end is closed: by itself, or because its process has ended.
    [[nodiscard]] bool hasGone() {
        readEvents();
        return gone_;
    }
    // The socket to poll together with the watched one.
    [[nodiscard]] void* handle() { return events_.handle(); }

  private:
    // Each event has two parts: its number, and the address, which does not matter here.
    void readEvents() {
        zmq::message_t number;
        zmq::message_t address;
        while (receive(events_, number) && receive(events_, address)) {
            std::uint16_t event = 0;
            std::memcpy(&event, number.data(), std::min(number.size(), sizeof event));
            gone_ = gone_ || (come_ && event == ZMQ_EVENT_DISCONNECTED);
            come_ = come_ || event == ZMQ_EVENT_HANDSHAKE_SUCCEEDED;
        }
    }

    zmq::socket_t events_;
    bool come_ = false;
    bool gone_ = false;
};

class ZmqFrameSender final : public FrameSender {
  public:
    explicit ZmqFrameSender(const std::filesystem::path& path)
        : socket_(openSocket(context_, zmq::socket_type::push, kFrameQueue, kMostFrameBytes)),
          receiver_(context_, socket_) {
        socket_.set(zmq::sockopt::linger, 0);
        socket_.set(zmq::sockopt::immediate,
                    true);  // frames are queued only for a connected receiver
        try {
            socket_.connect(addressOf(path));
        } catch (const zmq::error_t& error) {
            refuse(path, error.what());
        }
        const Moment giveUp = monotonicNow() + kPatience;
        while (!receiver_.hasCome()) {
            if (monotonicNow() > giveUp) refuse(path, "nobody receives them");
            std::array items{zmq::pollitem_t{receiver_.handle(), 0, ZMQ_POLLIN, 0}};
            pollItems(items, kBetweenLooks);
        }
    }
    ~ZmqFrameSender() override {
        const Moment giveUp = monotonicNow() + kLastFrames;
        zmq::message_t end;
        bool said = false;
        while (!receiver_.hasGone() && monotonicNow() < giveUp) {
            said = said || trySend(end);
            std::array items{
                zmq::pollitem_t{socket_.handle(), 0, said ? short{0} : short{ZMQ_POLLOUT}, 0},
                zmq::pollitem_t{receiver_.handle(), 0, ZMQ_POLLIN, 0}};
            pollItems(items, kBetweenLooks);
        }
    }
    ZmqFrameSender(const ZmqFrameSender&) = delete;
    ZmqFrameSender& operator=(const ZmqFrameSender&) = delete;

    void send(const RawFrame& frame) override {
        assert(frame.rgb.size() == codesIn({0, frame.width, frame.height}));
        const FrameHeader header{frame.frame, frame.width, frame.height};
        zmq::message_t message(sizeof header + frame.rgb.size());
        std::memcpy(message.data(), &header, sizeof header);
        std::ranges::transform(frame.rgb,
                               message.data<std::uint8_t>() + sizeof header,
                               [](std::uint16_t code) { return static_cast<std::uint8_t>(code); });
        while (receiver_.hasGone() || !trySend(message)) {
            if (receiver_.hasGone())
                throw Error("the encoder of the clip has ended; see its message");
            std::array items{zmq::pollitem_t{socket_.handle(), 0, ZMQ_POLLOUT, 0},
                             zmq::pollitem_t{receiver_.handle(), 0, ZMQ_POLLIN, 0}};
            pollItems(items, std::chrono::milliseconds(-1));
        }
    }

  private:
    [[noreturn]] static void refuse(const std::filesystem::path& path, const std::string& why) {
        throw Error(path.string() + ": no frames can be sent there (" + why +
                    "); start aquarama-compose clip first");
    }
    // False where the queue is full, or a signal came; the message is still whole then.
    bool trySend(zmq::message_t& message) {
        try {
            return socket_.send(message, zmq::send_flags::dontwait).has_value();
        } catch (const zmq::error_t&) {  // a signal
            return false;
        }
    }

    zmq::context_t context_{1};
    zmq::socket_t socket_;
    PeerWatch receiver_;
};

class ZmqFrameReceiver final : public FrameReceiver {
  public:
    explicit ZmqFrameReceiver(const std::filesystem::path& path)
        : name_(path.string()),
          socket_(openSocket(context_, zmq::socket_type::pull, kFrameQueue, kMostFrameBytes)),
          sender_(context_, socket_) {
        try {
            socket_.bind(addressOf(path));
        } catch (const zmq::error_t& error) {
            throw Error(name_ + ": no frames can be received there (" + error.what() +
                        "); choose a folder of a local disk, and a short path");
        }
    }

    std::optional<RawFrame> receive() override {
        if (ended_) return std::nullopt;
        zmq::message_t message;
        while (!net::receive(socket_, message)) {
            if (sender_.hasGone()) {  // no end was sent: the sender has died
                if (net::receive(socket_, message)) break;
                return end();
            }
            std::array items{zmq::pollitem_t{socket_.handle(), 0, ZMQ_POLLIN, 0},
                             zmq::pollitem_t{sender_.handle(), 0, ZMQ_POLLIN, 0}};
            pollItems(items, std::chrono::milliseconds(-1));
        }
        if (message.size() == 0) return end();
        return frameIn(message);
    }

  private:
    // Closes the connection, for which the sender waits.
    std::nullopt_t end() {
        ended_ = true;
        socket_.close();
        return std::nullopt;
    }
    // The size is compared with the header's before memory is taken.
    [[nodiscard]] RawFrame frameIn(const zmq::message_t& message) const {
        FrameHeader header;
        std::memcpy(&header, message.data(), std::min(message.size(), sizeof header));
        if (header.width < 0 || header.height < 0 ||
            message.size() != sizeof header + codesIn(header))
            throw Error(name_ + ": a message is not a frame; use nodes of this version");
        const auto* codes = message.data<std::uint8_t>() + sizeof header;
        return {header.frame, header.width, header.height, {codes, codes + codesIn(header)}};
    }

    std::string name_;
    zmq::context_t context_{1};
    zmq::socket_t socket_;
    PeerWatch sender_;
    bool ended_ = false;
};

}  // namespace

std::filesystem::path frameSocket(const std::filesystem::path& folder, const std::string& channel) {
    return folder / channel;
}

std::unique_ptr<FrameSender> connectFrames(const std::filesystem::path& path) {
    return std::make_unique<ZmqFrameSender>(path);
}

std::unique_ptr<FrameReceiver> bindFrames(const std::filesystem::path& path) {
    return std::make_unique<ZmqFrameReceiver>(path);
}

}  // namespace aquarama::net
