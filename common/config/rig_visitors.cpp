// SPDX-License-Identifier: Apache-2.0
#include "common/config/rig_visitors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

#include "common/config/host.h"
#include "common/config/rig_network.h"
#include "common/config/rig_parts.h"

namespace aquarama::config {

namespace {

// Throws Error at the field, or its entry `index`, where it is no address of UDP.
UdpAddress udpOf(const TextReader& file,
                 const google::protobuf::Message& in,
                 const std::string& field,
                 const std::string& text,
                 int index = 0) {
    if (const auto address = udpAddressIn(text)) return *address;
    file.refuse(in,
                field,
                field + " \"" + text +
                    "\" is no address of one machine: write udp://192.168.7.1:PORT; names are not "
                    "looked up",
                index);
}

// Throws Error at the entry of `from` that is no host.
std::vector<std::string> hostsOf(const TextReader& file,
                                 const google::protobuf::Message& in,
                                 const google::protobuf::RepeatedPtrField<std::string>& from) {
    std::vector<std::string> hosts;
    for (int i = 0; i < from.size(); ++i) {
        hosts.push_back(shortestHost(from[i]));
        if (hosts.back().empty())
            file.refuse(in,
                        "from",
                        "from \"" + from[i] +
                            "\" is no number of one machine: write 192.168.7.40, without a port",
                        i);
    }
    return hosts;
}

std::optional<OscCues> oscOf(const TextReader& file, const v1::Rig& rig) {
    if (!rig.cues().has_osc()) return std::nullopt;
    const v1::OscCues& in = rig.cues().osc();
    OscCues osc{udpOf(file, in, "listen", in.listen()), hostsOf(file, in, in.from()), {}};
    const auto isVersion6 = [](const UdpAddress& address) {
        return address.host.find(':') != std::string::npos;
    };
    for (int i = 0; i < in.send_to_size(); ++i) {
        osc.sendTo.push_back(udpOf(file, in, "send_to", in.send_to(i), i));
        if (isVersion6(osc.sendTo.back()) != isVersion6(osc.listen))
            file.refuse(
                in,
                "send_to",
                "send_to \"" + in.send_to(i) +
                    "\" is of another version than listen: write both as IPv4 or both as IPv6",
                i);
    }
    return osc;
}

std::optional<DmxCues> dmxOf(const TextReader& file, const v1::Rig& rig) {
    if (!rig.cues().has_art_net()) return std::nullopt;
    const v1::DmxCues& in = rig.cues().art_net();
    DmxCues dmx;
    dmx.universe = in.universe();
    if (in.has_brightness()) dmx.brightness = in.brightness();
    if (in.has_black()) dmx.black = in.black();
    if (!dmx.brightness && !dmx.black)
        file.refuse(
            rig.cues(), "art_net", "art_net drives nothing: give brightness, black or both");
    if (dmx.brightness == dmx.black)
        file.refuse(in, "black", "black has the channel of brightness: give each one of its own");
    return dmx;
}

// Of "http://192.168.20.1:7490": the same machines and ports as those of UDP.
std::optional<UdpAddress> webAddressIn(const std::string& address) {
    constexpr std::string_view kWebScheme = "http://";
    if (!address.starts_with(kWebScheme)) return std::nullopt;
    return udpAddressIn("udp://" + address.substr(kWebScheme.size()));
}

// Three corners of a surface; of people, of a floor that is below the viewer's eye.
void checkCorners(const TextReader& file,
                  const v1::Touch& in,
                  const TouchedSurface& touch,
                  glm::dvec3 sweetSpot) {
    constexpr double kLeastMetres = 0.05, kLeastSine = 0.05, kMostSlope = 0.5;
    const glm::dvec3 across = touch.topRight - touch.topLeft;
    const glm::dvec3 down = touch.bottomLeft - touch.topLeft;
    const double least = std::min(glm::length(across), glm::length(down));
    const glm::dvec3 normal = glm::cross(across, down);
    const double area = glm::length(normal);
    if (least < kLeastMetres || area < kLeastSine * glm::length(across) * glm::length(down))
        file.refuse(in,
                    "bottom_left",
                    "top_left, top_right and bottom_left lie on one line, or nearly: give three "
                    "corners of the surface");
    if (!touch.peopleReachMetres) return;
    const double highest = std::max({touch.topLeft.y, touch.topRight.y, touch.bottomLeft.y});
    if (std::hypot(normal.x, normal.z) > kMostSlope * area || highest >= sweetSpot.y)
        file.refuse(in,
                    "people",
                    "the three corners of people lie on the floor, below the sweet spot: give "
                    "them its y_m, or leave people out");
}

std::optional<TouchedSurface> touchOf(const TextReader& file, const v1::Rig& rig) {
    if (!rig.has_touch()) return std::nullopt;
    const v1::Touch& in = rig.touch();
    TouchedSurface touch{udpOf(file, in, "listen", in.listen()),
                         hostsOf(file, in, in.from()),
                         positionOf(in.top_left()),
                         positionOf(in.top_right()),
                         positionOf(in.bottom_left())};
    if (touch.from.empty()) touch.from.emplace_back("127.0.0.1");
    if (in.has_people()) touch.peopleReachMetres = in.people().reach_m();
    checkCorners(file, in, touch, positionOf(rig.sweet_spot()));
    return touch;
}

// The host of the master, and a port that nobody else has.
void checkPictures(const TextReader& file, const v1::Rig& rig) {
    const v1::Guests& in = rig.guests();
    const v1::Network& network = rig.network();
    checkAddress(file, in, "pictures", in.pictures());
    const auto isTaken = [&](const std::string& other) {
        return !other.empty() && portOf(other) == portOf(in.pictures());
    };
    if (hostOf(in.pictures()) != hostOf(network.control()) || isTaken(network.control()) ||
        isTaken(network.state()) || isTaken(network.watch()) || isTaken(network.depot()))
        file.refuse(in, "pictures", "pictures needs the host of control and a port of its own");
}

void takeGuests(const TextReader& file, const v1::Rig& in, Rig& rig) {
    if (!in.has_guests()) return;
    static_assert(v1::Guests::UPPER_RIGHT - v1::Guests::LOWER_LEFT ==
                  static_cast<int>(Guests::Corner::UpperRight));
    const v1::Guests& from = in.guests();
    Guests guests{.host = {},
                  .port = 0,
                  .channel = from.has_channel() ? from.channel() : rig.channels.front().name,
                  .corner = static_cast<Guests::Corner>(from.corner() - v1::Guests::LOWER_LEFT),
                  .height = from.height(),
                  .picturesAddress = from.pictures()};
    const auto address = webAddressIn(from.address());
    if (!address)
        file.refuse(from,
                    "address",
                    "address \"" + from.address() +
                        "\" is no address of this machine that phones reach: write "
                        "http://192.168.20.1:7490 or http://[fd00::1]:7490; names are not looked "
                        "up");
    guests.host = address->host;
    guests.port = address->port;
    if (from.has_pictures()) checkPictures(file, in);
    if (std::ranges::find(rig.channels, guests.channel, &Channel::name) == rig.channels.end())
        file.refuse(from, "channel", "there is no channel \"" + guests.channel + "\"");
    rig.guests = guests;
}

std::optional<DrawingRules> drawingsOf(const TextReader& file, const v1::Rig& rig) {
    if (!rig.has_drawings()) return std::nullopt;
    const v1::Drawings& in = rig.drawings();
    DrawingRules rules{.species = {in.species().begin(), in.species().end()},
                       .most = in.most(),
                       .areLetInAtOnce = in.let_in() == v1::Drawings::AT_ONCE,
                       .mayBeEaten = in.may_be_eaten(),
                       .folder = in.folder()};
    if (rules.species.empty())
        rules.species = {
            "clownfish", "blue_tang", "butterflyfish", "parrotfish", "moorish_idol", "lionfish"};
    if (!rules.folder.empty() && !rig.network().has_console_port())
        file.refuse(in,
                    "folder",
                    "pictures in a folder are read by the console: give network a console_port, "
                    "or leave folder out");
    return rules;
}

}  // namespace

void takeVisitors(const TextReader& file, const v1::Rig& in, Rig& rig) {
    rig.cues = {oscOf(file, in), dmxOf(file, in)};
    takeGuests(file, in, rig);
    rig.touch = touchOf(file, in);
    rig.drawings = drawingsOf(file, in);
}

}  // namespace aquarama::config
