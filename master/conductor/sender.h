// SPDX-License-Identifier: Apache-2.0
// What a run of the master says to its peers: encodes each message and hands it to the channels.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "common/net/blob.h"
#include "common/net/channels.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {

// Of the conductor's thread.
class Sender {
  public:
    // Sends bytes to a peer.
    using Send = std::function<void(const net::PeerId&, net::ByteView)>;
    // `session`: of this run of the master. `send` must not throw.
    Sender(std::uint64_t session, Send send) : session_{session}, send_{std::move(send)} {}

    // The run of the master.
    [[nodiscard]] std::uint64_t session() const { return session_; }
    // A message of this run as the bytes that are sent.
    [[nodiscard]] wire::Packet packetOf(v1::Envelope message) const {
        return wire::encode(session_, std::move(message));
    }
    void send(const net::PeerId& peer, net::ByteView packet) const { send_(peer, packet); }
    void say(const net::PeerId& peer, v1::Envelope message) const {
        send_(peer, packetOf(std::move(message)));
    }
    // Answers a request for a part of this blob, which is not null.
    void sayChunk(const net::PeerId& peer,
                  const v1::BlobRequest& request,
                  const net::Blob& blob) const {
        const auto content = net::chunkAt(*blob, request.offset(), wire::kBlobChunkBytes);
        v1::Envelope message;
        v1::BlobChunk& chunk = *message.mutable_blob_chunk();
        chunk.set_digest(request.digest());
        chunk.set_offset(request.offset());
        chunk.set_total(blob->size());
        chunk.set_content(content.data(), content.size());
        say(peer, std::move(message));
    }
    // Tells the peer that it is not counted, or not any more.
    void dismiss(const net::PeerId& peer, const std::string& why) const {
        v1::Envelope message;
        message.mutable_dismissed()->set_reason(why);
        say(peer, std::move(message));
    }
    // The same, as another machine is the master from now on.
    void handOver(const net::PeerId& peer) const {
        v1::Envelope message;
        message.mutable_dismissed()->set_reason("the master changes");
        message.mutable_dismissed()->set_hands_over(true);
        say(peer, std::move(message));
    }

  private:
    std::uint64_t session_;
    Send send_;
};

}  // namespace aquarama::conductor
