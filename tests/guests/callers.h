// SPDX-License-Identifier: Apache-2.0
// Phones that call a guest service without a server, and a wall that remembers what it is told.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "guests/guests.h"

namespace aquarama::test {

using guests::GuestService;
using guests::OfferedSkin;
using guests::VisitedWall;
using nlohmann::json;

struct RecordedWall final : VisitedWall {
    void steer(const Steering& steering) override { hands.push_back(steering); }
    void feed(const glm::vec3& position) override { food.push_back(position); }
    void show(const wire::Sign& sign) override { signs.push_back(sign); }
    void offer(OfferedSkin skin) override { offers.push_back(std::move(skin)); }
    void watch(const std::set<std::uint32_t>& fish) override { watched = fish; }
    std::vector<Steering> hands;
    std::vector<glm::vec3> food;
    std::vector<wire::Sign> signs;
    std::vector<OfferedSkin> offers;
    std::set<std::uint32_t> watched;
};

struct RecordedOutbox final : web::Outbox {
    void put(const std::string& topic, web::Payload payload, bool /*isBinary*/) override {
        said[topic] = json::parse(*payload);
    }
    void close(std::uint16_t code) override { closed = code; }
    std::map<std::string, json> said;
    std::uint16_t closed = 0;
};

// A phone with its connection.
struct Caller {
    explicit Caller(GuestService& service,
                    const std::string& first = "",
                    const std::string& host = "10.0.0.1:7490") {
        connection = service.open(
            {.target = "/g", .host = host, .origin = "http://" + host}, outbox, refusal);
        if (!first.empty()) say(first);
    }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;
    void say(const std::string& text) const { connection->hear(text); }
    [[nodiscard]] json state() { return outbox.said["state"]; }
    [[nodiscard]] std::string you() { return state()["you"]; }
    [[nodiscard]] std::string resuming() {
        return json{{"resume", outbox.said["session"]["session"]}}.dump();
    }
    RecordedOutbox outbox;
    web::HttpReply refusal;
    std::unique_ptr<web::Service::Connection> connection;
};

}  // namespace aquarama::test
