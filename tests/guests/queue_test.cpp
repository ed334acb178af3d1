// SPDX-License-Identifier: Apache-2.0
#include "guests/queue.h"

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace aquarama::guests {
namespace {

std::vector<GuestId> namesIn(const VisitorQueue& queue) {
    std::vector<GuestId> names;
    for (const GuestSeat& seat : queue.seats()) names.push_back(seat.guest);
    return names;
}

TEST(VisitorQueue, turnsFollowEachOtherWithARestBetween) {
    VisitorQueue queue;
    EXPECT_TRUE(queue.join("a"));
    EXPECT_TRUE(queue.join("b"));
    EXPECT_FALSE(queue.join("a")) << "nobody is in line twice";
    EXPECT_EQ(queue.pilot(0), "a");
    EXPECT_EQ(queue.waitOf("a", 20), 0);
    EXPECT_EQ(queue.waitOf("b", 20), 41);
    EXPECT_FALSE(queue.waitOf("c", 20).has_value());
    EXPECT_EQ(queue.pilot(59.9), "a");
    EXPECT_EQ(queue.pilot(60), std::nullopt);
    EXPECT_EQ(queue.pilot(61), "b");
    EXPECT_TRUE(queue.join("a")) << "behind the others";
    EXPECT_EQ(namesIn(queue), (std::vector<GuestId>{"b", "a"}));
}

TEST(VisitorQueue, holdsTwelve) {
    VisitorQueue queue;
    for (std::size_t i = 0; i < VisitorQueue::kMostSeats; ++i)
        EXPECT_TRUE(queue.join(std::to_string(i)));
    EXPECT_FALSE(queue.join("late"));
    queue.leave("5", 0);
    EXPECT_TRUE(queue.join("late"));
    EXPECT_EQ(queue.seats().back().guest, "late");
}

TEST(VisitorQueue, aLockedPhoneBlocksNobodyAndKeepsItsSeat) {
    VisitorQueue queue;
    for (const char* const guest : {"a", "b", "c"}) queue.join(guest);
    queue.lost("a", 0);
    EXPECT_EQ(queue.pilot(0), "b") << "the first who is there";
    queue.back("a");
    EXPECT_EQ(queue.waitOf("a", 0), 61) << "next after b";
    EXPECT_EQ(queue.pilot(60), std::nullopt);
    EXPECT_EQ(queue.pilot(61), "a");
    queue.lost("c", 61);
    EXPECT_EQ(queue.pilot(105.9), "a");
    EXPECT_EQ(queue.seats().size(), 2U);
    EXPECT_EQ(queue.pilot(106), "a");
    EXPECT_EQ(namesIn(queue), (std::vector<GuestId>{"a"})) << "c was away for 45 s";
}

TEST(VisitorQueue, aLostPilotGivesTheHelmToWhoIsThereAndKeepsTheRestOfHisTurn) {
    VisitorQueue queue;
    for (const char* const guest : {"a", "b"}) queue.join(guest);
    EXPECT_EQ(queue.pilot(0), "a");
    queue.lost("a", 10);
    EXPECT_EQ(queue.pilot(14.9), "a");
    EXPECT_EQ(queue.pilot(15), std::nullopt);
    EXPECT_EQ(queue.pilot(16), "b");
    queue.back("a");
    EXPECT_EQ(queue.pilot(76), std::nullopt);
    EXPECT_EQ(queue.pilot(77), "a");
    EXPECT_EQ(queue.leftOf(queue.seats().front(), 77), 45);
    EXPECT_EQ(queue.pilot(122), std::nullopt);
    EXPECT_TRUE(queue.seats().empty());
}

TEST(VisitorQueue, aLostPilotWithNobodyBehindKeepsTheHelmUntilHisSeatIsGiven) {
    VisitorQueue queue;
    queue.join("a");
    EXPECT_EQ(queue.pilot(0), "a");
    queue.lost("a", 1);
    EXPECT_EQ(queue.pilot(45), "a");
    EXPECT_EQ(queue.pilot(46), std::nullopt);
    EXPECT_TRUE(queue.seats().empty());
}

TEST(VisitorQueue, seatsOfAnEarlierRunAreHeld) {
    VisitorQueue queue;
    queue.restore({{"a", 12, {}}, {"b", 60, {}}}, 100);
    queue.join("c");
    EXPECT_EQ(queue.pilot(100), "c") << "nobody else is there yet";
    queue.back("a");
    EXPECT_EQ(queue.waitOf("a", 100), 61);
    static_cast<void>(queue.pilot(145));
    EXPECT_EQ(namesIn(queue), (std::vector<GuestId>{"a", "c"})) << "b never came back";
}

// One line of random guests, who come, go, are lost and come back at random times.
class History {
  public:
    explicit History(unsigned seed) : random_{seed} {}
    void run() {
        for (int step = 0; step < 40 && !testing::Test::HasFailure(); ++step) {
            now_ += pick(4) == 0 ? pick(600) / 10.0 : pick(20) / 10.0;
            act(std::string(1, static_cast<char>('a' + pick(20))));
            check();
        }
    }

  private:
    unsigned pick(unsigned count) { return static_cast<unsigned>(random_() % count); }

    void act(const GuestId& guest) {
        switch (pick(6)) {
            case 0:
            case 1:
                if (queue_.join(guest)) joined_[guest] = ++count_;
                break;
            case 2:
                queue_.lost(guest, now_);
                break;
            case 3:
            case 4:
                queue_.back(guest);
                break;
            default:
                queue_.leave(guest, now_);
                break;
        }
    }

    void check() {
        const auto before = queue_.steering();
        const std::vector<GuestSeat> seatsBefore = queue_.seats();
        const auto pilot = queue_.pilot(now_);
        const auto& seats = queue_.seats();
        ASSERT_LE(seats.size(), VisitorQueue::kMostSeats);
        ASSERT_TRUE(std::ranges::is_sorted(seats, {}, [&](const GuestSeat& seat) {
            return joined_.at(seat.guest);
        })) << "order kept, nobody twice";
        ASSERT_FALSE(before && pilot && before != pilot) << "a rest lies between two pilots";
        for (const GuestSeat& seat : seatsBefore) checkSeat(seat, seat.guest == before);
        if (!pilot || pilot == before) return;
        began_ = now_;
        for (const GuestSeat& seat : seats) {
            if (seat.guest == pilot) {
                ASSERT_FALSE(seat.awaySince) << "who steers is there";
                break;
            }
            ASSERT_TRUE(seat.awaySince) << "the first who is there is next";
        }
    }

    // A seat is given up only at the end of a turn, or after its owner was away for long.
    void checkSeat(const GuestSeat& seat, bool isPilot) {
        const auto& seats = queue_.seats();
        const bool isThere = std::ranges::find(seats, seat.guest, &GuestSeat::guest) != seats.end();
        const bool isTooLongAway = seat.awaySince && now_ - *seat.awaySince >= times_.held;
        const bool isOver = isPilot && now_ - began_ >= seat.left;
        ASSERT_EQ(isThere, !isTooLongAway && !isOver) << seat.guest;
    }

    std::minstd_rand random_;
    QueueTimes times_;
    VisitorQueue queue_{times_};
    std::map<GuestId, int> joined_;
    double now_ = 0, began_ = 0;
    int count_ = 0;
};

TEST(VisitorQueue, keepsItsRulesInRandomHistories) {
    for (unsigned seed = 1; seed <= 100'000 && !HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        History(seed).run();
    }
}

// Whoever stays is at the helm no later than he was told, plus a rest for each time that a lost
// pilot gave the helm away.
TEST(VisitorQueue, waitsAreHonest) {
    for (unsigned seed = 1; seed <= 2000 && !HasFailure(); ++seed) {
        std::minstd_rand random(seed);
        VisitorQueue queue;
        for (const char* const guest : {"a", "b", "c", "d", "e"}) queue.join(guest);
        queue.join("me");
        const double told = *queue.waitOf("me", 0);
        double now = 0;
        int changes = 0;
        std::optional<GuestId> last;
        while (queue.pilot(now) != "me" && now < 1000) {
            if (queue.steering() && queue.steering() != last) ++changes;
            last = queue.steering();
            const GuestId other(1, static_cast<char>('a' + random() % 5));
            if (random() % 50 == 0) queue.lost(other, now);
            if (random() % 20 == 0) queue.back(other);
            now += 0.5;
        }
        const int rotations = std::max(changes - 5, 0);
        EXPECT_LE(now, told + 1.5 * rotations + 0.5 * changes) << "seed " << seed;
    }
}

}  // namespace
}  // namespace aquarama::guests
