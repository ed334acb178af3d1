// SPDX-License-Identifier: Apache-2.0
// Pictures that phones send: who may, what becomes of them, and how much the server reads.
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/base/files.h"
#include "common/config/host.h"
#include "guests/guests.h"
#include "tests/guests/callers.h"

namespace aquarama::guests {
namespace {

using ask::DrawingOutcome;
using nlohmann::json;
using test::Caller;
using Condition = WallDrawing::Condition;

// A picture that waits for its reader.
struct Picture {
    std::string bytes;
    std::function<void(const DrawingOutcome&)> done;
};

class VisitorDrawingsTest : public testing::Test {
  protected:
    VisitorDrawingsTest() { begin(); }

    void begin() {
        service.reset();
        service.emplace(
            GuestsOptions{.place = {.host = "10.0.0.1", .port = 7490, .channel = {}},
                          .key = kKey,
                          .seatFile = folder.path() / "seats",
                          .drawings = {.species = {"clownfish", "blue_tang"},
                                       .read =
                                           [this](std::string bytes, auto done) {
                                               pictures.push_back({std::move(bytes), done});
                                               return pictures.size() <= mostPictures;
                                           }}},
            wall,
            [this] { return now; });
        hear({});
    }
    void hear(const WallDrawings& drawings) {
        service->heard(WallState{
            .isOpen = true, .eye = {}, .drawings = std::make_shared<const WallDrawings>(drawings)});
    }
    void pass(double seconds) {
        for (int ticks = static_cast<int>(seconds * 10 + 0.5); ticks > 0; --ticks) {
            now += 0.1;
            service->tick();
        }
    }
    [[nodiscard]] std::string entering() const {
        return json{{"enter", DoorTokens(kKey).wordAt(now)}}.dump();
    }
    static std::string secretOf(Caller& phone) { return phone.outbox.said["session"]["session"]; }
    static web::HttpRequest request(const std::string& secret, const std::string& side = "left") {
        return {.method = "POST",
                .target = "/drawing/" + side,
                .host = "10.0.0.1:7490",
                .origin = "http://10.0.0.1:7490",
                .authorization = "Bearer " + secret};
    }
    // As the server does: the status, and the word of a refusal.
    std::pair<int, std::string> send(web::HttpRequest request) {
        web::HttpReply refusal;
        const auto admission = service->admit(request, refusal);
        if (!admission) return {refusal.status, refusal.body};
        request.body = "picture";
        const web::HttpReply reply = service->answer(request);
        return {reply.status, reply.body};
    }
    // What the page of a phone is told.
    static json told(Caller& phone) { return phone.state()["drawings"]; }

    static constexpr DoorTokens::Key kKey{7};
    TemporaryFolder folder{"guests"};
    double now = 1000;
    test::RecordedWall wall;
    std::vector<Picture> pictures;
    std::size_t mostPictures = 1000;
    std::optional<GuestService> service;
};

using Said = std::pair<int, std::string>;

TEST_F(VisitorDrawingsTest, aPictureBecomesAFishWithANumber) {
    Caller phone(*service, entering());
    EXPECT_EQ(told(phone)["fish"], json::array());
    EXPECT_EQ(send(request(secretOf(phone))), Said(202, ""));
    pass(0.5);
    EXPECT_EQ(told(phone)["reading"], true);
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_EQ(pictures[0].bytes, "picture");
    pictures[0].done(ask::ReadDrawing{"blue_tang", "skin"});
    ASSERT_EQ(wall.offers.size(), 1U);
    EXPECT_EQ(wall.offers[0].species, "blue_tang");
    EXPECT_EQ(wall.offers[0].skin, "skin");
    EXPECT_EQ(wall.offers[0].aside, -1);
    service->offered(wall.offers[0].request, 17);
    pass(0.5);
    EXPECT_EQ(told(phone)["fish"], json::array()) << "the wall has not listed it yet";
    hear({{17, {}}});
    pass(0.5);
    EXPECT_EQ(told(phone)["reading"], false);
    EXPECT_EQ(told(phone)["fish"], json::parse(R"([{"number":17,"is":"waiting"}])"));
}

TEST_F(VisitorDrawingsTest, itsMakerIsToldWhatTheFishDoes) {
    Caller phone(*service, entering());
    EXPECT_EQ(send(request(secretOf(phone), "middle")).first, 202);
    pictures[0].done(ask::ReadDrawing{"clownfish", "skin"});
    EXPECT_EQ(wall.offers[0].aside, 0);
    service->offered(wall.offers[0].request, 17);
    hear({{17, {Condition::Swimming, 240}}, {18, {Condition::Swimming, 241}}});
    pass(0.5);
    EXPECT_EQ(wall.watched, std::set<std::uint32_t>{240}) << "of no other fish";
    service->does(240, {.does = "hide", .whom = "", .saw = "blacktip_reef_shark"});
    pass(0.5);
    EXPECT_EQ(told(phone)["fish"][0], json::parse(R"({"number":17,"is":"swimming","does":"hide",
        "whom":"","saw":"blacktip_reef_shark"})"));
    for (const auto& [condition, name] :
         {std::pair{Condition::Homeless, "homeless"}, std::pair{Condition::Leaving, "leaving"}}) {
        hear({{17, {condition, {}}}});
        pass(0.5);
        EXPECT_EQ(told(phone)["fish"][0]["is"], name);
    }
    hear({});
    pass(0.5);
    EXPECT_EQ(told(phone)["fish"][0]["is"], "gone");
    EXPECT_TRUE(wall.watched.empty());
    phone.connection.reset();
    hear({{17, {Condition::Swimming, 240}}});
    pass(0.5);
    EXPECT_TRUE(wall.watched.empty()) << "nobody looks";
}

TEST_F(VisitorDrawingsTest, whatIsRefusedIsSaid) {
    Caller phone(*service, entering());
    const auto refusal = [&](const DrawingOutcome& outcome) {
        EXPECT_EQ(send(request(secretOf(phone))).first, 202);
        pictures.back().done(outcome);
        pass(30.1);
        return told(phone)["refused"].get<std::string>();
    };
    EXPECT_EQ(refusal(ask::DrawingRefused{"no_sheet"}), "no_sheet");
    EXPECT_EQ(refusal(ask::ReadDrawing{"lionfish", "skin"}), "unknown_species");
    EXPECT_TRUE(wall.offers.empty());
    EXPECT_EQ(send(request(secretOf(phone))).first, 202);
    pass(0.5);
    EXPECT_EQ(told(phone)["refused"], "") << "until there is an answer to the next";
    pictures.back().done(ask::ReadDrawing{"clownfish", "skin"});
    service->offered(wall.offers[0].request, 0);
    EXPECT_EQ(told(phone)["refused"], "no_room");
    EXPECT_EQ(told(phone)["reading"], false);
    service->offered(4711, 5);  // of nobody
}

TEST_F(VisitorDrawingsTest, onlyVisitorsMaySendAndOnlyNowAndThen) {
    Caller phone(*service, entering());
    const std::string secret = secretOf(phone);
    EXPECT_EQ(send(request("")), Said(401, "session"));
    EXPECT_EQ(send(request(std::string(32, '0'))), Said(401, "session"));
    EXPECT_EQ(send(request(secret, "above")), Said(404, "off"));
    web::HttpRequest foreign = request(secret);
    foreign.origin = "http://evil.example";
    EXPECT_EQ(send(foreign).first, 403);
    foreign.host = "evil.example";
    EXPECT_EQ(send(foreign).first, 403);
    EXPECT_EQ(pictures.size(), 0U);
    EXPECT_EQ(send(request(secret)).first, 202);
    EXPECT_EQ(send(request(secret)), Said(429, "soon"));
    pass(31);
    EXPECT_EQ(send(request(secret)), Said(429, "soon")) << "the first is still being read";
    pictures[0].done(ask::DrawingRefused{"no_sheet"});
    EXPECT_EQ(send(request(secret)).first, 202);
    pass(0.5);
    EXPECT_EQ(told(phone)["wait_s"], 30);
}

TEST_F(VisitorDrawingsTest, ofManyPhonesSomeMustWait) {
    std::vector<std::unique_ptr<Caller>> phones;
    int taken = 0;
    for (int i = 0; i < 12; ++i) {
        phones.push_back(std::make_unique<Caller>(*service, entering()));
        taken += send(request(secretOf(*phones.back()))).first == 202 ? 1 : 0;
    }
    EXPECT_EQ(taken, 8);
    EXPECT_EQ(send(request(secretOf(*phones[11]))), Said(503, "crowd"));
    pass(2.1);
    EXPECT_EQ(send(request(secretOf(*phones[11]))).first, 202) << "one in two seconds";
    mostPictures = 0;
    pass(2.1);
    EXPECT_EQ(send(request(secretOf(*phones[10]))), Said(503, "crowd")) << "of the reader";
}

TEST_F(VisitorDrawingsTest, nothingIsDrawnWhereTheWallTakesNoDrawings) {
    Caller phone(*service, entering());
    service->heard(WallState{.isOpen = true, .eye = {}});
    pass(0.5);
    EXPECT_FALSE(phone.state().contains("drawings"));
    EXPECT_EQ(send(request(secretOf(phone))), Said(503, "off"));
    service->heard(WallState{.isOpen = false, .eye = {}});
    EXPECT_EQ(send(request(secretOf(phone))).first, 403);
}

TEST_F(VisitorDrawingsTest, numbersSurviveARestartAndALongAbsence) {
    std::optional<Caller> phone;
    phone.emplace(*service, entering());
    const std::string resuming = phone->resuming(), secret = secretOf(*phone);
    for (std::uint32_t number = 21; number <= 24; ++number) {
        EXPECT_EQ(send(request(secret)).first, 202);
        pictures.back().done(ask::ReadDrawing{"clownfish", "skin"});
        service->offered(wall.offers.back().request, number);
        hear({{number, {}}});
        pass(30.1);
    }
    EXPECT_EQ(told(*phone)["fish"].size(), 3U) << "the newest";
    phone.reset();
    begin();
    now += 3600;
    pass(1);
    phone.emplace(*service, resuming);
    EXPECT_EQ(told(*phone)["fish"][0]["number"], 22);
    EXPECT_EQ(told(*phone)["fish"][2]["number"], 24);
}

v1::Explanation explanation(v1::Explanation::Intention intention, const std::string& target) {
    v1::Explanation told;
    told.set_intention(intention);
    told.set_target(target);
    return told;
}

TEST_F(VisitorDrawingsTest, aPictureThatAKilledProgramWasReadingIsSaidToBeLost) {
    std::optional<Caller> phone;
    phone.emplace(*service, entering());
    const std::string resuming = phone->resuming();
    EXPECT_EQ(send(request(secretOf(*phone))).first, 202);
    const auto seats = folder.path() / "seats", kept = folder.path() / "kept";
    std::filesystem::copy_file(seats, kept);
    phone.reset();
    service.reset();
    std::filesystem::copy_file(kept, seats, std::filesystem::copy_options::overwrite_existing);
    begin();
    Caller again(*service, resuming);
    hear({});
    pass(0.5);
    EXPECT_EQ(told(again)["refused"], "lost");
    EXPECT_EQ(told(again)["reading"], false);
}

TEST(Deed, isWhatTheMasterSays) {
    EXPECT_EQ(deedOf({}), FishDeed{}) << "it is away";
    EXPECT_EQ(deedOf(explanation(v1::Explanation::AVOID_FISH, "#12 blue_tang")),
              (FishDeed{"avoid_fish", "blue_tang", ""}));
    EXPECT_EQ(deedOf(explanation(v1::Explanation::EAT, "particle 7")), (FishDeed{"eat", "", ""}));
    v1::Explanation hides = explanation(v1::Explanation::HIDE, "site 5");
    v1::Sighting& food = *hides.add_seen();
    food.set_kind(v1::Sighting::FOOD);
    food.set_name("particle 3");
    v1::Sighting& shark = *hides.add_seen();
    shark.set_kind(v1::Sighting::PREDATOR);
    shark.set_name("#300 blacktip_reef_shark");
    EXPECT_EQ(deedOf(hides), (FishDeed{"hide", "", "blacktip_reef_shark"}));
    hides.set_intention(v1::Explanation::WANDER);
    EXPECT_EQ(deedOf(hides).saw, "") << "it does not mind";
}

// A port of the loopback, of version 4 or 6.
struct Place {
    Place(const std::string& host, std::uint16_t port) {
        if (host == "::1")
            six = {.sin6_family = AF_INET6,
                   .sin6_port = htons(port),
                   .sin6_flowinfo = 0,
                   .sin6_addr = in6addr_loopback,
                   .sin6_scope_id = 0};
        else
            four = {.sin_family = AF_INET,
                    .sin_port = htons(port),
                    .sin_addr = {htonl(INADDR_LOOPBACK)},
                    .sin_zero = {}};
    }
    union {
        sockaddr any{};
        sockaddr_in four;
        sockaddr_in6 six;
    };
    socklen_t size = sizeof(sockaddr_in6);
};

// A port that nobody listens at.
std::uint16_t freePort(const std::string& host) {
    Place place(host, 0);
    const int probe = socket(place.any.sa_family, SOCK_STREAM, 0);
    bind(probe, &place.any, place.size);
    getsockname(probe, &place.any, &place.size);
    close(probe);
    return ntohs(place.any.sa_family == AF_INET6 ? place.six.sin6_port : place.four.sin_port);
}

// A connection by hand.
class Client {
  public:
    explicit Client(const Place& place) : socket_{socket(place.any.sa_family, SOCK_STREAM, 0)} {
        const timeval patience{20, 0};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
        EXPECT_EQ(connect(socket_, &place.any, place.size), 0);
    }
    ~Client() { close(socket_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;
    // False: the server reads no more.
    bool say(std::string_view text) const {
        while (!text.empty()) {
            const ssize_t count = send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
            if (count <= 0) return false;
            text.remove_prefix(static_cast<std::size_t>(count));
        }
        return true;
    }
    // The status of the answer and its last line; 0: the server has hung up.
    Said answer() const {
        std::string text;
        std::array<char, 4096> piece{};
        while (text.find("\r\n\r\n") == std::string::npos) {
            const ssize_t count = recv(socket_, piece.data(), piece.size(), 0);
            if (count <= 0) return {0, ""};
            text.append(piece.data(), static_cast<std::size_t>(count));
        }
        return {std::stoi(text.substr(9, 3)), text.substr(text.find("\r\n\r\n") + 4)};
    }

  private:
    int socket_;
};

// The same service, behind a server at an address of the loopback.
class DrawingsOverHttp : public testing::TestWithParam<const char*> {
  protected:
    DrawingsOverHttp() {
        service.heard(WallState{
            .isOpen = true, .eye = {}, .drawings = std::make_shared<const WallDrawings>()});
        for (std::string& secret : secrets) {
            Caller caller(service, json{{"enter", DoorTokens(kKey).wordAt(1000)}}.dump(), host);
            secret = caller.outbox.said["session"]["session"];
        }
    }
    ~DrawingsOverHttp() override {
        server.stop();
        if (thread.joinable()) thread.join();
    }
    void begin() {
        thread = std::thread([this] { server.run(); });
    }
    [[nodiscard]] std::string head(std::size_t visitor, const std::string& more) const {
        return "POST /drawing/right HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
               "\r\nAuthorization: Bearer " + secrets.at(visitor) + "\r\n" + more + "\r\n\r\n";
    }
    [[nodiscard]] std::string sized(std::size_t visitor, std::size_t bytes) const {
        return head(visitor, "Content-Length: " + std::to_string(bytes));
    }

    static constexpr DoorTokens::Key kKey{7};
    static constexpr std::size_t kMost = ask::kMostPictureBytes;
    TemporaryFolder folder{"guests"};
    const std::string address = GetParam();
    std::uint16_t port = freePort(address);
    Place place{address, port};
    std::string host = config::bracketed(address) + ":" + std::to_string(port);
    test::RecordedWall wall;
    std::vector<std::size_t> sizes;  // of the pictures that arrived
    GuestService service{{.place = {.host = address, .port = port, .channel = {}},
                          .key = kKey,
                          .seatFile = folder.path() / "seats",
                          .drawings = {.species = {"clownfish"},
                                       .read =
                                           [this](const std::string& bytes, const auto&) {
                                               sizes.push_back(bytes.size());
                                               return true;
                                           }}},
                         wall,
                         [] { return 1000.0; }};
    std::array<std::string, 10> secrets;
    web::WebServer server{{.address = address, .port = port, .certificateFile = {}, .keyFile = {}},
                          service};
    std::thread thread;
};

TEST_P(DrawingsOverHttp, aPictureOfSixteenMegabytesIsReadAndOneMoreByteIsNot) {
    begin();
    const Client whole(place), larger(place), page(place);
    EXPECT_TRUE(whole.say(sized(0, kMost)) && whole.say(std::string(kMost, 'x')));
    EXPECT_EQ(whole.answer(), Said(202, ""));
    larger.say(sized(1, kMost + 1));
    EXPECT_EQ(larger.answer().first, 0) << "before any of it is sent";
    EXPECT_EQ(server.cutOff(), 1U);
    page.say("GET / HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
    EXPECT_EQ(page.answer().first, 200);
    server.stop();
    thread.join();
    EXPECT_EQ(sizes, std::vector<std::size_t>{kMost});
}

TEST_P(DrawingsOverHttp, aLengthThatIsNotSaidIsBoundedAsWell) {
    begin();
    const Client client(place);
    EXPECT_TRUE(client.say(head(0, "Transfer-Encoding: chunked")));
    const std::string chunk = "100000\r\n" + std::string(0x100000, 'x') + "\r\n";
    int sent = 0;
    while (sent < 40 && client.say(chunk)) ++sent;
    EXPECT_LT(sent, 40);
    EXPECT_EQ(client.answer().first, 0);
    EXPECT_TRUE(sizes.empty());
}

TEST_P(DrawingsOverHttp, aRefusalIsHeardAlsoWhileThePictureIsBeingSent) {
    secrets[0] = "nobody";
    begin();
    const Client client(place);
    EXPECT_TRUE(client.say(sized(0, 4'000'000)));
    EXPECT_TRUE(client.say(std::string(4'000'000, 'x'))) << "nothing is cut off meanwhile";
    EXPECT_EQ(client.answer(), Said(401, "session"));
    EXPECT_TRUE(sizes.empty());
}

TEST_P(DrawingsOverHttp, whoSendsSlowlyTakesAPlaceOnlyAsLongAsHeIsThere) {
    begin();
    std::vector<std::unique_ptr<Client>> slow;
    for (std::size_t i = 0; i < VisitorDrawings::kMostUploads; ++i) {
        slow.push_back(std::make_unique<Client>(place));
        slow.back()->say(sized(i, 1000) + "some");
    }
    const Client late(place);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    late.say(sized(8, 4) + "some");
    EXPECT_EQ(late.answer(), Said(503, "crowd"));
    slow[0]->say(std::string(996, 'x'));
    EXPECT_EQ(slow[0]->answer(), Said(202, ""));
}

INSTANTIATE_TEST_SUITE_P(OfVersions4And6,
                         DrawingsOverHttp,
                         testing::Values("127.0.0.1", "::1"),
                         [](const auto& tested) {
                             return tested.param == std::string("::1") ? "six" : "four";
                         });

TEST_P(DrawingsOverHttp, otherRequestsHaveShortBodies) {
    begin();
    const Client client(place);
    client.say("POST / HTTP/1.1\r\nHost: " + host + "\r\nContent-Length: 70000\r\n\r\n");
    EXPECT_EQ(client.answer().first, 0);
    EXPECT_EQ(server.cutOff(), 1U);
}

}  // namespace
}  // namespace aquarama::guests
