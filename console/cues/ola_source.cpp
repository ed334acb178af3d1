// SPDX-License-Identifier: Apache-2.0
// Where OLA's client library is installed; else no_ola_source.cpp is built.
#include <ola/DmxBuffer.h>
#include <ola/client/ClientWrapper.h>
#include <ola/client/OlaClient.h>

#include "common/base/log.h"
#include "console/cues/dmx_source.h"

namespace aquarama::console {

namespace {

constexpr const char* kNoAnswer =
    "olad does not answer on this machine; install the package ola, and start olad";

// Callbacks of OLA come within hear(), and the library owns the objects that wrap them.
class OlaSource final : public DmxSource {
  public:
    explicit OlaSource(std::uint32_t universe) : universe_{universe} {
        if (!wrapper_.Setup()) throw Error(kNoAnswer);
        wrapper_.SetCloseCallback(ola::NewCallback(this, &OlaSource::close));
        ola::client::OlaClient& client = *wrapper_.GetClient();
        client.SetDMXCallback(ola::NewCallback(this, &OlaSource::take));
        client.RegisterUniverse(
            universe, ola::client::REGISTER, ola::NewSingleCallback(this, &OlaSource::registered));
    }

    std::optional<DmxFrame> hear() override {
        for (int pass = 0; pass < kPasses; ++pass) wrapper_.GetSelectServer()->RunOnce();
        if (!problem_.empty()) throw Error(problem_);
        return std::exchange(heard_, {});
    }

  private:
    void close() { problem_ = kNoAnswer; }
    void registered(const ola::client::Result& result) {
        if (!result.Success()) problem_ = "olad refuses the universe: " + result.Error();
    }
    void take(const ola::client::DMXMetadata& of, const ola::DmxBuffer& channels) {
        if (of.universe != universe_) return;
        heard_ = DmxFrame(channels.GetRaw(), channels.GetRaw() + channels.Size());
    }

    static constexpr bool kStartsOlad = false;
    // Each takes one message of olad's; a universe of DMX has 44 frames a second at most, and this
    // is called ten times a second.
    static constexpr int kPasses = 16;

    std::uint32_t universe_;
    std::optional<DmxFrame> heard_;
    std::string problem_;
    ola::client::OlaClientWrapper wrapper_{kStartsOlad};  // last: it calls this
};

}  // namespace

std::unique_ptr<DmxSource> openUniverse(std::uint32_t universe) {
    return std::make_unique<OlaSource>(universe);
}

}  // namespace aquarama::console
