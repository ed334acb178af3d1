// SPDX-License-Identifier: Apache-2.0
// Fetches what visitors have painted: the list of skins that frames name, then its pictures.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/base/digest.h"
#include "common/body/side_skin.h"
#include "common/net/blob.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"

namespace aquarama::session {

// Beside the fetch of a look, and in memory only: visitors' drawings are not kept on a node's disk.
// Another thread checks and decodes. A picture that is no skin is one warning; it is not asked for
// again. Used by the net thread.
class SkinFetch {
  public:
    // All skins that are there, by number; not null.
    using Skins = std::shared_ptr<const body::SkinsByNumber>;
    // `say` sends a message to the master. `wake` makes the net thread call turn() soon; it is
    // called from another thread. `offer` takes all skins that are there, whenever others are.
    SkinFetch(std::function<void(v1::Envelope)> say,
              std::function<void()> wake,
              std::function<void(Skins)> offer);

    // The list of the newest frame; nothing: no fish has a skin of its own.
    void want(const std::optional<Digest>& list);
    // What was asked of a master that is lost is asked again.
    void restart() { assembly_.reset(); }
    void take(const v1::BlobChunk& chunk);
    // Goes on with what has come.
    void turn(net::Moment now);
    // Whether all skins of the newest list are there, or were refused.
    [[nodiscard]] bool isComplete() const;

  private:
    struct Listed {
        std::uint32_t number = 0;
        Digest picture;
        std::string species;
    };
    // A picture that has come; null: it is still being decoded, or it was refused.
    struct Come {
        std::shared_ptr<const body::SideSkin> skin;
        bool isDone = false;
    };
    struct Decoded {
        Digest picture;
        std::shared_ptr<const body::SideSkin> skin;  // null: refused
        std::string problem;
    };
    // A blob that has come whole: the list, or a picture.
    void settle(net::BlobAssembly whole);
    void readList(net::BlobAssembly& whole);
    void unreadable();
    void decodeNext();
    void keep(const Decoded& decoded);
    void refuse(const Digest& picture, const std::string& problem);
    void offerAll();
    void requestChunk();
    [[nodiscard]] std::optional<Decoded> takeDecoded();
    [[nodiscard]] std::optional<Digest> firstMissing() const;

    std::function<void(v1::Envelope)> say_;
    std::function<void()> wake_;
    std::function<void(Skins)> offer_;
    std::optional<Digest> list_;
    bool isListRead_ = true;
    std::vector<Listed> listed_;               // of the last list that was read
    std::map<Digest, Come> pictures_;          // of these
    std::deque<net::BlobAssembly> undecoded_;  // whole pictures
    std::optional<net::BlobAssembly> assembly_;
    net::Moment lastRequest_{};
    bool isDecoding_ = false;
    std::mutex mutex_;  // guards decoded_
    std::optional<Decoded> decoded_;
    std::future<void> decoding_;  // last: it uses all of the above
};

}  // namespace aquarama::session
