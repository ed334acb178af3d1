// SPDX-License-Identifier: Apache-2.0
#include "common/enrol/discovery.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>

#include <avahi-common/address.h>
#include <avahi-common/malloc.h>

#include "common/enrol/mdns.h"

namespace aquarama::enrol {

namespace {

// More than these are not waiting, but somebody floods the network.
constexpr std::size_t kMostNodes = 100;
constexpr std::size_t kMostLetters = 3, kKeyLetters = 40;

bool isLetter(const std::string& name) {
    return !name.empty() && name.size() <= kMostLetters &&
           std::ranges::all_of(name, [](char c) { return c >= 'A' && c <= 'Z'; });
}

bool isPrintable(const std::string& text) {
    return std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; });
}

// The key in a service's text; empty where it has none that can be one.
std::string keyIn(AvahiStringList* text) {
    AvahiStringList* const entry = avahi_string_list_find(text, "key");
    if (entry == nullptr) return {};
    char* value = nullptr;
    std::size_t size = 0;
    if (avahi_string_list_get_pair(entry, nullptr, &value, &size) != 0) return {};
    const std::string key(value != nullptr ? value : "", value != nullptr ? size : 0);
    avahi_free(value);
    return key.size() == kKeyLetters && isPrintable(key) ? key : std::string();
}

std::string addressOf(const AvahiAddress& address, std::uint16_t port) {
    std::array<char, AVAHI_ADDRESS_STR_MAX> text{};
    avahi_address_snprint(text.data(), text.size(), &address);
    return "tcp://" + std::string(text.data()) + ":" + std::to_string(port);
}

}  // namespace

class Discovery::Browser {
  public:
    Browser() : stack_{[](AvahiServer*, AvahiServerState) {}} {
        browser_.reset(avahi_s_service_browser_new(stack_.server(),
                                                   AVAHI_IF_UNSPEC,
                                                   AVAHI_PROTO_INET,
                                                   kServiceType,
                                                   nullptr,
                                                   AvahiLookupFlags{},
                                                   &Browser::onService,
                                                   this));
        stack_.start();
    }
    ~Browser() {
        stack_.stop();
        resolvers_.clear();
        browser_.reset();
    }
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    [[nodiscard]] std::vector<FoundNode> nodes() const {
        const std::lock_guard lock(mutex_);
        std::vector<FoundNode> found;
        for (const auto& [place, node] : found_)
            if (found.empty() || found.back().letter != node.letter) found.push_back(node);
        std::ranges::stable_sort(
            found, {}, [](const FoundNode& node) { return node.letter.size(); });
        return found;
    }

  private:
    // A node is found once on each interface.
    using Place = std::pair<std::string, AvahiIfIndex>;
    using Resolver = std::unique_ptr<AvahiSServiceResolver, Free<avahi_s_service_resolver_free>>;

    static void onService(AvahiSServiceBrowser* browser,
                          AvahiIfIndex interface,
                          AvahiProtocol protocol,
                          AvahiBrowserEvent event,
                          const char* name,
                          const char* type,
                          const char* domain,
                          AvahiLookupResultFlags flags,
                          void* self);
    static void onResolved(AvahiSServiceResolver* resolver,
                           AvahiIfIndex interface,
                           AvahiProtocol protocol,
                           AvahiResolverEvent event,
                           const char* name,
                           const char* type,
                           const char* domain,
                           const char* host,
                           const AvahiAddress* address,
                           std::uint16_t port,
                           AvahiStringList* text,
                           AvahiLookupResultFlags flags,
                           void* self);
    void came(const Place& place, const char* domain);
    void went(const Place& place);
    void know(const Place& place, const FoundNode& node) {
        const std::lock_guard lock(mutex_);
        found_[place] = node;
    }

    mutable std::mutex mutex_;
    std::map<Place, FoundNode> found_;
    std::map<Place, Resolver> resolvers_;  // each follows its service; of the stack's thread
    MdnsStack stack_;
    ServiceBrowser browser_;
};

void Discovery::Browser::onService(AvahiSServiceBrowser* /*browser*/,
                                   AvahiIfIndex interface,
                                   AvahiProtocol /*protocol*/,
                                   AvahiBrowserEvent event,
                                   const char* name,
                                   const char* /*type*/,
                                   const char* domain,
                                   AvahiLookupResultFlags /*flags*/,
                                   void* self) {
    auto& own = *static_cast<Browser*>(self);
    if (name == nullptr || !isLetter(name)) return;
    if (event == AVAHI_BROWSER_NEW) own.came({name, interface}, domain);
    if (event == AVAHI_BROWSER_REMOVE) own.went({name, interface});
}

void Discovery::Browser::came(const Place& place, const char* domain) {
    if (resolvers_.size() >= kMostNodes) return;
    resolvers_[place].reset(avahi_s_service_resolver_new(stack_.server(),
                                                         place.second,
                                                         AVAHI_PROTO_INET,
                                                         place.first.c_str(),
                                                         kServiceType,
                                                         domain,
                                                         AVAHI_PROTO_INET,
                                                         AvahiLookupFlags{},
                                                         &Browser::onResolved,
                                                         this));
}

void Discovery::Browser::went(const Place& place) {
    resolvers_.erase(place);
    const std::lock_guard lock(mutex_);
    found_.erase(place);
}

void Discovery::Browser::onResolved(AvahiSServiceResolver* /*resolver*/,
                                    AvahiIfIndex interface,
                                    AvahiProtocol /*protocol*/,
                                    AvahiResolverEvent event,
                                    const char* name,
                                    const char* /*type*/,
                                    const char* /*domain*/,
                                    const char* /*host*/,
                                    const AvahiAddress* address,
                                    std::uint16_t port,
                                    AvahiStringList* text,
                                    AvahiLookupResultFlags /*flags*/,
                                    void* self) {
    if (event != AVAHI_RESOLVER_FOUND || address == nullptr) return;
    const std::string key = keyIn(text);
    if (key.empty()) return;
    static_cast<Browser*>(self)->know({name, interface}, {name, addressOf(*address, port), key});
}

Discovery::Discovery() : browser_{std::make_unique<Browser>()} {}

Discovery::~Discovery() = default;

std::vector<FoundNode> Discovery::nodes() const {
    return browser_->nodes();
}

}  // namespace aquarama::enrol
