// SPDX-License-Identifier: Apache-2.0
#include "common/enrol/mdns.h"

#include <array>

#include <arpa/inet.h>
#include <avahi-common/error.h>
#include <avahi-common/malloc.h>
#include <avahi-core/log.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include "common/base/log.h"
#include "common/base/random_bytes.h"
#include "common/enrol/discovery.h"

namespace aquarama::enrol {

namespace {

// Avahi says on standard error which interface it joins, and that another stack is there.
void keepToErrors(AvahiLogLevel level, const char* text) {
    if (level <= AVAHI_LOG_ERROR) logWarning("multicast DNS: {}", text);
}

// No other machine has this name, whatever its own one is.
std::string freshHostName() {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string name = "aquarama-";
    for (const unsigned char byte : randomBytes<8>()) name += kDigits[byte & 15U];
    return name;
}

// Several stacks on one machine would contend for its addresses: each publishes its own service.
AvahiServerConfig quietConfig() {
    AvahiServerConfig config;
    avahi_server_config_init(&config);
    config.host_name = avahi_strdup(freshHostName().c_str());
    config.use_ipv6 = 0;
    config.publish_hinfo = config.publish_workstation = 0;
    config.publish_addresses = config.publish_domain = 0;
    config.enable_wide_area = 0;
    return config;
}

bool isUsable(const ifaddrs& entry) {
    return entry.ifa_addr != nullptr && entry.ifa_addr->sa_family == AF_INET &&
           (entry.ifa_flags & IFF_UP) != 0;
}

std::string textOf(const ifaddrs& entry) {
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* in = reinterpret_cast<const sockaddr_in*>(entry.ifa_addr);
    inet_ntop(AF_INET, &in->sin_addr, text.data(), text.size());
    return text.data();
}

}  // namespace

MdnsStack::MdnsStack(OnState onState)
    : onState_{std::move(onState)}, poll_{avahi_threaded_poll_new()} {
    avahi_set_log_function(keepToErrors);
    AvahiServerConfig config = quietConfig();
    int error = AVAHI_OK;
    const auto hear = [](AvahiServer* server, AvahiServerState state, void* self) {
        static_cast<MdnsStack*>(self)->onState_(server, state);
    };
    server_.reset(
        avahi_server_new(avahi_threaded_poll_get(poll_.get()), &config, hear, this, &error));
    avahi_server_config_free(&config);
    if (!server_)
        throw Error(std::string("nodes without a key cannot be found on the network: ") +
                    avahi_strerror(error) + "; see that UDP port 5353 is free for multicast DNS");
}

MdnsStack::~MdnsStack() {
    stop();
}

void MdnsStack::start() {
    isRunning_ = avahi_threaded_poll_start(poll_.get()) == 0;
}

void MdnsStack::stop() {
    if (std::exchange(isRunning_, false)) avahi_threaded_poll_stop(poll_.get());
}

std::vector<OwnAddress> addressesByInterface() {
    std::vector<OwnAddress> networks, loopback;
    ifaddrs* all = nullptr;
    if (getifaddrs(&all) != 0) return {};
    for (const ifaddrs* entry = all; entry != nullptr; entry = entry->ifa_next) {
        if (!isUsable(*entry)) continue;
        auto& found = (entry->ifa_flags & IFF_LOOPBACK) != 0 ? loopback : networks;
        found.push_back({static_cast<int>(if_nametoindex(entry->ifa_name)), textOf(*entry)});
    }
    freeifaddrs(all);
    return networks.empty() ? loopback : networks;
}

std::vector<std::string> ownAddresses() {
    std::vector<std::string> addresses;
    for (const OwnAddress& own : addressesByInterface()) addresses.push_back(own.address);
    return addresses;
}

}  // namespace aquarama::enrol
