// SPDX-License-Identifier: Apache-2.0
#include <mutex>

#include <avahi-common/error.h>

#include "common/base/log.h"
#include "common/base/random_bytes.h"
#include "common/enrol/discovery.h"
#include "common/enrol/mdns.h"

namespace aquarama::enrol {

namespace {

constexpr int kLetters = 26;

// A to Z, then AA.
std::string letterOf(int number) {
    std::string letter(1, static_cast<char>('A' + number % kLetters));
    return number < kLetters ? letter : letterOf(number / kLetters - 1) + letter;
}

// At random: of two nodes that start at the same moment with the same letter both may give way, as
// Avahi compares their records one by one. With a next letter they would collide again for ever.
int numberAfter(int collisions) {
    constexpr int kMostOfOneLetter = 10;
    const int number = randomBytes<1>()[0];
    return collisions < kMostOfOneLetter ? number % kLetters : number;
}

}  // namespace

// The service of a waiting node. Another node with the same letter is noticed by the protocol
// (RFC 6762, 8.2): whoever gives way tries another letter.
class Announcement::Service {
  public:
    Service(std::string publicKey, std::uint16_t port)
        : publicKey_{std::move(publicKey)},
          port_{port},
          stack_{[this](AvahiServer* server, AvahiServerState state) { hear(server, state); }} {
        stack_.start();
    }
    ~Service() {
        stack_.stop();
        group_.reset();
    }
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    [[nodiscard]] std::string letter() const {
        const std::lock_guard lock(mutex_);
        return letter_;
    }
    void followAddresses() {
        stack_.between([&] {
            if (group_ && addressesByInterface() != addresses_) publish(stack_.server());
        });
    }

  private:
    void hear(AvahiServer* server, AvahiServerState state) {
        if (state == AVAHI_SERVER_RUNNING) publishAny(server);
    }
    void hear(AvahiServer* server, AvahiEntryGroupState state) {
        if (state == AVAHI_ENTRY_GROUP_ESTABLISHED) {
            const std::lock_guard lock(mutex_);
            letter_ = letterOf(number_);
        }
        if (state == AVAHI_ENTRY_GROUP_COLLISION) {
            ++collisions_;
            publishAny(server);
        }
    }
    void publishAny(AvahiServer* server) {
        number_ = numberAfter(collisions_);
        publish(server);
    }
    void publish(AvahiServer* server);
    // Avahi's error, as a number.
    [[nodiscard]] int add(AvahiServer* server);

    std::string publicKey_;
    std::uint16_t port_;
    mutable std::mutex mutex_;
    std::string letter_;  // established; the rest is of the stack's thread
    int collisions_ = 0;
    int number_ = 0;  // of the letter that is tried
    std::vector<OwnAddress> addresses_;
    EntryGroup group_;
    MdnsStack stack_;
};

// Anew, under the letter that is tried now.
void Announcement::Service::publish(AvahiServer* server) {
    if (group_)
        avahi_s_entry_group_reset(group_.get());
    else
        group_.reset(avahi_s_entry_group_new(
            server,
            [](AvahiServer* of, AvahiSEntryGroup*, AvahiEntryGroupState state, void* self) {
                static_cast<Service*>(self)->hear(of, state);
            },
            this));
    addresses_ = addressesByInterface();
    int error = group_ ? add(server) : avahi_server_errno(server);
    if (error == AVAHI_OK) error = avahi_s_entry_group_commit(group_.get());
    if (error != AVAHI_OK)
        logWarning("nobody can find this node on the network: {}", avahi_strerror(error));
}

// On each interface its own address: whoever asks there can reach it.
int Announcement::Service::add(AvahiServer* server) {
    const std::string letter = letterOf(number_);
    const StringList text(avahi_string_list_new(("key=" + publicKey_).c_str(), nullptr));
    for (const auto& [interface, address] : addresses_) {
        AvahiAddress own{};
        avahi_address_parse(address.c_str(), AVAHI_PROTO_INET, &own);
        const int error = avahi_server_add_address(server,
                                                   group_.get(),
                                                   interface,
                                                   AVAHI_PROTO_INET,
                                                   AVAHI_PUBLISH_NO_REVERSE,
                                                   nullptr,
                                                   &own);
        if (error != AVAHI_OK) return error;
    }
    return avahi_server_add_service_strlst(server,
                                           group_.get(),
                                           AVAHI_IF_UNSPEC,
                                           AVAHI_PROTO_INET,
                                           AvahiPublishFlags{},
                                           letter.c_str(),
                                           kServiceType,
                                           nullptr,
                                           nullptr,
                                           port_,
                                           text.get());
}

Announcement::Announcement(std::string publicKey, std::uint16_t port)
    : service_{std::make_unique<Service>(std::move(publicKey), port)} {}

Announcement::~Announcement() = default;

std::string Announcement::letter() const {
    return service_->letter();
}

void Announcement::followAddresses() {
    service_->followAddresses();
}

}  // namespace aquarama::enrol
