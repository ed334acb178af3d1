// SPDX-License-Identifier: Apache-2.0
#include "common/config/rig_network.h"

#include <charconv>
#include <optional>

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
    if (!in.has_watch()) return;
    checkAddress(file, in, "watch", in.watch());
    if (hostOf(in.watch()) != hostOf(in.control()) || portOf(in.watch()) == portOf(in.control()) ||
        portOf(in.watch()) == portOf(in.state()))
        file.refuse(in, "watch", "watch needs the host of control and a port of its own");
}

}  // namespace aquarama::config
