// SPDX-License-Identifier: Apache-2.0
#include "console/cues/udp_port.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::console {

namespace {

// An address in the kernel's form, of either version.
struct Place {
    union {
        sockaddr any;
        sockaddr_in four;
        sockaddr_in6 six;
    };
    socklen_t size = sizeof(sockaddr_in6);
    Place() : six{} {}
};

Place placeOf(const config::UdpAddress& address) {
    Place place;
    const std::uint16_t port = htons(address.port);
    if (inet_pton(AF_INET6, address.host.c_str(), &place.six.sin6_addr) == 1) {
        place.six.sin6_family = AF_INET6;
        place.six.sin6_port = port;
        return place;
    }
    place.four = {};
    place.size = sizeof(sockaddr_in);
    place.four.sin_family = AF_INET;
    place.four.sin_port = port;
    inet_pton(AF_INET, address.host.c_str(), &place.four.sin_addr);
    return place;
}

config::UdpAddress addressOf(const Place& place) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    const bool isVersion6 = place.any.sa_family == AF_INET6;
    const void* const number = isVersion6 ? static_cast<const void*>(&place.six.sin6_addr)
                                          : static_cast<const void*>(&place.four.sin_addr);
    inet_ntop(place.any.sa_family, number, text.data(), text.size());
    return {text.data(), ntohs(isVersion6 ? place.six.sin6_port : place.four.sin_port)};
}

}  // namespace

UdpPort::UdpPort(const config::UdpAddress& at) {
    const Place place = placeOf(at);
    socket_ = socket(place.any.sa_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket_ >= 0 && bind(socket_, &place.any, place.size) == 0) return;
    const std::string why = std::strerror(errno);
    if (socket_ >= 0) close(socket_);
    throw Error("cannot listen at " + config::textOf(at) + ": " + why +
                "; the address is one of this machine, and no other program has the port");
}

UdpPort::~UdpPort() {
    close(socket_);
}

std::optional<UdpPort::Datagram> UdpPort::receive(std::size_t most) {
    Datagram datagram;
    datagram.bytes.resize(most);
    Place from;
    const ssize_t size = recvfrom(socket_, datagram.bytes.data(), most, 0, &from.any, &from.size);
    if (size < 0) return std::nullopt;
    datagram.bytes.resize(static_cast<std::size_t>(size));
    datagram.from = addressOf(from);
    return datagram;
}

void UdpPort::send(const config::UdpAddress& to, std::span<const std::byte> bytes) {
    const Place place = placeOf(to);
    static_cast<void>(sendto(socket_, bytes.data(), bytes.size(), 0, &place.any, place.size));
}

}  // namespace aquarama::console
