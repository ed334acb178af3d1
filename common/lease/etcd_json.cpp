// SPDX-License-Identifier: Apache-2.0
#include "common/lease/etcd_json.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>

#include <nlohmann/json.hpp>

#include "common/base/log.h"

namespace aquarama::lease {

namespace {

using nlohmann::json;

constexpr std::string_view kBase64 =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::size_t kMostNameBytes = 64;

std::string base64(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t j = 0; j < 3; ++j)
            bits =
                bits << 8U | (i + j < text.size() ? static_cast<unsigned char>(text[i + j]) : 0U);
        for (std::size_t j = 0; j < 4; ++j)
            out += i + j <= text.size() ? kBase64[bits >> (18 - 6 * j) & 63U] : '=';
    }
    return out;
}

// Printable, as it is shown in logs; cut to kMostNameBytes. Other characters than those of base64
// end it.
std::string nameIn(std::string_view coded) {
    std::string out;
    std::uint32_t bits = 0;
    unsigned count = 0;
    for (const char c : coded) {
        const std::size_t value = kBase64.find(c);
        if (value == std::string_view::npos || out.size() == kMostNameBytes) break;
        bits = bits << 6U | static_cast<std::uint32_t>(value);
        if ((count += 6) < 8) continue;
        count -= 8;
        const char byte = static_cast<char>(bits >> count & 0xFFU);
        out += byte >= ' ' && byte <= '~' ? byte : '?';
    }
    return out;
}

[[noreturn]] void refuse(const std::string& why) {
    throw Error("etcd answers with " + why);
}

json objectIn(const std::string& body) {
    json parsed = json::parse(body, nullptr, /*allow_exceptions=*/false);
    if (!parsed.is_object()) refuse("what is no JSON object");
    return parsed;
}

// A member that is left out is 0, "" or false, as protobuf's JSON has it.
const json* memberOf(const json& object, const char* name) {
    if (!object.is_object()) refuse(std::string("no object around ") + name);
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
}

const json& objectOf(const json& object, const char* name) {
    const json* const member = memberOf(object, name);
    if (member == nullptr || !member->is_object()) refuse(std::string("no ") + name);
    return *member;
}

const json& firstOf(const json& object, const char* name) {
    const json* const list = memberOf(object, name);
    if (list == nullptr || !list->is_array() || list->empty()) refuse(std::string("no ") + name);
    return list->front();
}

// Of 64 bits, as a string.
std::int64_t numberOf(const json& object, const char* name) {
    const json* const member = memberOf(object, name);
    if (member == nullptr) return 0;
    if (!member->is_string()) refuse(std::string(name) + " that is no string");
    const auto& text = member->get_ref<const std::string&>();
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < 0)
        refuse(std::string(name) + " that is no number");
    return number;
}

// Lives are whole seconds; nobody here grants long ones.
LeaseAnswer leaseIn(const json& object) {
    constexpr std::int64_t kMostSeconds = 3600;
    const LeaseAnswer answer{numberOf(object, "ID"),
                             static_cast<int>(std::min(numberOf(object, "TTL"), kMostSeconds))};
    if (answer.lease == 0) refuse("no lease");
    return answer;
}

// The only entry of an answer to a range.
std::optional<LeaseHolder> holderIn(const json& range) {
    const json* const entries = memberOf(range, "kvs");
    if (entries == nullptr || entries->empty()) return std::nullopt;
    if (!entries->is_array()) refuse("keys that are no list");
    const json& entry = entries->front();
    const json* const value = memberOf(entry, "value");
    const std::string name =
        value != nullptr && value->is_string() ? nameIn(value->get_ref<const std::string&>()) : "";
    return LeaseHolder{name,
                       numberOf(entry, "lease"),
                       static_cast<std::uint64_t>(numberOf(entry, "mod_revision"))};
}

}  // namespace

std::string grantRequest(int seconds) {
    return json{{"TTL", std::to_string(seconds)}}.dump();
}

std::string leaseRequest(std::int64_t lease) {
    return json{{"ID", std::to_string(lease)}}.dump();
}

std::string holderRequest(const LeaseKeys& keys) {
    return json{{"key", base64(keys.holder)}}.dump();
}

std::string takeRequest(const LeaseKeys& keys,
                        const std::string& name,
                        std::int64_t lease,
                        std::uint64_t last) {
    const std::string holder = base64(keys.holder), before = base64(keys.last);
    json compare = json::array(
        {{{"key", holder}, {"target", "CREATE"}, {"result", "EQUAL"}, {"create_revision", "0"}}});
    if (last != 0)
        compare.push_back({{"key", before},
                           {"target", "MOD"},
                           {"result", "EQUAL"},
                           {"mod_revision", std::to_string(last)}});
    const json put{{"key", holder}, {"value", base64(name)}, {"lease", std::to_string(lease)}};
    const json note{{"key", before}, {"value", base64(name)}};
    const json range{{"key", holder}};
    return json{{"compare", compare},
                {"success", json::array({{{"request_put", put}}, {{"request_put", note}}})},
                {"failure", json::array({{{"request_range", range}}})}}
        .dump();
}

LeaseAnswer grantAnswer(const std::string& body) {
    LeaseAnswer answer = leaseIn(objectIn(body));
    if (answer.seconds == 0) refuse("a lease of no time");
    return answer;
}

LeaseAnswer keepAliveAnswer(const std::string& body) {
    return leaseIn(objectOf(objectIn(body), "result"));
}

std::optional<LeaseHolder> holderAnswer(const std::string& body) {
    const json answer = objectIn(body);
    static_cast<void>(objectOf(answer, "header"));
    return holderIn(answer);
}

Taken takeAnswer(const std::string& body) {
    const json answer = objectIn(body);
    const std::int64_t revision = numberOf(objectOf(answer, "header"), "revision");
    const json* const succeeded = memberOf(answer, "succeeded");
    if (succeeded != nullptr && *succeeded == true) {
        if (revision == 0) refuse("no revision");
        return {static_cast<std::uint64_t>(revision), std::nullopt};
    }
    return {std::nullopt, holderIn(objectOf(firstOf(answer, "responses"), "response_range"))};
}

}  // namespace aquarama::lease
