// SPDX-License-Identifier: Apache-2.0
#include "common/config/rig_network.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/rig_parts.h"

namespace aquarama::config {

namespace {

std::optional<int> wholeNumber(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

bool isLoopback(std::string_view host) {
    return host == "localhost" || host == "[::1]" ||
           (host.starts_with("127.") && isAll(host, "0123456789."));
}

std::string_view hostOf(std::string_view address) {
    const std::size_t start = std::string_view("tcp://").size();
    return address.substr(start, address.rfind(':') - start);
}

namespace {

// Of a network card, as a number: a name could mean anything to a resolver.
bool isHost(std::string_view host) {
    const bool isEverywhere = host == "0.0.0.0" || host == "[::]";
    return isLoopback(host) || (!isEverywhere && (isAll(host, "0123456789.") ||
                                                  (host.starts_with('[') && host.ends_with(']'))));
}

}  // namespace

void checkAddress(const TextReader& file,
                  const google::protobuf::Message& in,
                  const std::string& field,
                  const std::string& address) {
    const auto refuse = [&](const std::string& why) {
        file.refuse(in, field, field + " \"" + address + "\" " + why);
    };
    const std::string_view scheme = "tcp://";
    const std::size_t colon = address.rfind(':');
    if (!address.starts_with(scheme) || colon < scheme.size())
        refuse("is no address: write tcp://127.0.0.1:PORT");
    const std::optional<int> port = wholeNumber(std::string_view(address).substr(colon + 1));
    if (!port || *port < 1 || *port > 65535) refuse("needs a port from 1 to 65535");
    if (!isHost(hostOf(address)))
        refuse("needs the number of one network card, as tcp://192.168.7.1:" +
               std::to_string(*port));
}

std::string portOf(const std::string& address) {
    return address.substr(address.rfind(':'));
}

namespace {

// An address beside control and state: of the same host, and with a port that none of `taken` has.
void checkBeside(const TextReader& file,
                 const v1::Network& in,
                 const std::string& field,
                 const std::string& address,
                 const std::vector<std::string>& taken) {
    checkAddress(file, in, field, address);
    const bool isTaken = std::ranges::any_of(taken, [&](const std::string& other) {
        return !other.empty() && portOf(other) == portOf(address);
    });
    if (hostOf(address) != hostOf(in.control()) || isTaken)
        file.refuse(in, field, field + " needs the host of control and a port of its own");
}

}  // namespace

void checkNetwork(const TextReader& file, const v1::Network& in) {
    checkAddress(file, in, "control", in.control());
    checkAddress(file, in, "state", in.state());
    if (portOf(in.control()) == portOf(in.state()))
        file.refuse(in, "state", "state and control share one port: give each its own");
    if (isLoopback(hostOf(in.control())) != isLoopback(hostOf(in.state())))
        file.refuse(in,
                    "state",
                    "only one of state and control reaches past this machine: use one "
                    "host for both");
    if (in.has_watch()) checkBeside(file, in, "watch", in.watch(), {in.control(), in.state()});
    if (in.has_depot())
        checkBeside(file, in, "depot", in.depot(), {in.control(), in.state(), in.watch()});
}

namespace {

bool isPort(std::string_view text) {
    const int port = wholeNumber(text).value_or(0);
    return port >= 1 && port <= 65535;
}

// Why a member of etcd cannot be reached so; empty where it can.
std::string objectionTo(const std::string& url) {
    const std::size_t slashes = url.find("://");
    const std::size_t colon = url.rfind(':');
    const std::string_view text = url, scheme = text.substr(0, slashes);
    if (colon <= slashes || (scheme != "http" && scheme != "https"))
        return "is no address: write http://127.0.0.1:2379, or https://192.168.7.1:2379";
    const std::string_view host = text.substr(slashes + 3, colon - slashes - 3);
    if (!isPort(text.substr(colon + 1))) return "needs a port from 1 to 65535";
    if (!isHost(host)) return "needs the number of one network card, as https://192.168.7.1:2379";
    if (scheme == "http" && !isLoopback(host))
        return "reaches past this machine: write https, and give both certificates";
    return {};
}

}  // namespace

void checkStandby(const TextReader& file, const v1::Rig& in) {
    const v1::Standby& standby = in.standby();
    constexpr std::size_t kMostNameBytes = 64;  // as messages have it
    if (standby.machine().empty() || standby.machine().size() > kMostNameBytes ||
        standby.machine() == "main")
        file.refuse(
            standby,
            "machine",
            "machine needs a name of up to 64 characters, other than \"main\", which is the "
            "master's machine");
    const std::vector<std::string> taken{in.network().control(), in.network().state()};
    for (const auto& [field, address] :
         {std::pair("control", standby.control()), std::pair("state", standby.state())}) {
        checkAddress(file, standby, field, address);
        if (isLoopback(hostOf(address)) != isLoopback(hostOf(in.network().control())))
            file.refuse(standby,
                        field,
                        std::string(field) +
                            " of standby and of network: only one of them "
                            "reaches past this machine");
        if (std::ranges::find(taken, address) != taken.end())
            file.refuse(standby, field, std::string(field) + " is the master's own address");
    }
    if (standby.control() == standby.state())
        file.refuse(standby, "state", "state and control share one port: give each its own");
    for (int i = 0; i < standby.etcd_size(); ++i) {
        const std::string objection = objectionTo(standby.etcd(i));
        if (!objection.empty())
            file.refuse(standby, "etcd", "etcd \"" + standby.etcd(i) + "\" " + objection, i);
    }
}

}  // namespace aquarama::config
