// SPDX-License-Identifier: Apache-2.0
#include "console/certificate.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::console {
namespace {

namespace fs = std::filesystem;

constexpr double kDay = kSecondsOfDay;
constexpr UnixSeconds kBuilt = 1.79e9;  // in 2026
constexpr UnixSeconds kMade = kBuilt + 10 * kDay;

std::string textOf(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class CertificateTest : public testing::Test {
  protected:
    CertificateTest() {
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "other");
    }
    ~CertificateTest() override { fs::remove_all(folder_); }

    MadeCertificate make(UnixSeconds now, bool takesNewAuthority = false) {
        return makeCertificate(
            files_, {"192.168.7.1", "master.local"}, {now, kBuilt}, takesNewAuthority);
    }
    CertificateKeeper keeper() {
        CertificateKeeper keeper(files_, "aquarama console hall.txtpb --certify X", kBuilt);
        keeper.taken();
        return keeper;
    }
    // Of the faults; "certificate soon".
    static std::string keysOf(const std::vector<Fault>& faults) {
        std::string keys;
        for (const Fault& fault : faults) keys += (keys.empty() ? "" : ", ") + fault.key;
        return keys;
    }

    fs::path folder_ =
        fs::temp_directory_path() / ("aquarama-certificate-" + std::to_string(getpid()));
    CertificateFiles files_ = certificateFilesIn(folder_);
};

TEST_F(CertificateTest, oneRenewsItselfAMonthBeforeItsEnd) {
    make(kMade);
    const std::string key = textOf(files_.key);
    const std::string first = textOf(files_.certificate);
    CertificateKeeper keeper = this->keeper();
    EXPECT_FALSE(keeper.tend(kMade + 365 * kDay)) << "32 days are left";
    EXPECT_EQ(textOf(files_.certificate), first);
    const UnixSeconds later = kMade + 366.5 * kDay;
    EXPECT_TRUE(keeper.tend(later)) << "the server is to take it";
    EXPECT_NE(textOf(files_.certificate), first);
    EXPECT_EQ(textOf(files_.key), key) << "tablets and certificate fit at every moment";
    EXPECT_NEAR(validityOf(files_.certificate).until, later + 397 * kDay, 2);
    keeper.taken();
    EXPECT_FALSE(keeper.tend(later + 10));
    EXPECT_EQ(keysOf(keeper.faults(later + 10)), "");
    // For years, without a person, until the authority is over.
    for (UnixSeconds now = later; now < kMade + 3500 * kDay; now += kDay / 2) {
        if (keeper.tend(now)) keeper.taken();
        ASSERT_EQ(keysOf(keeper.faults(now)), "") << (now - kMade) / kDay;
        ASSERT_GT(keeper.validity().until, now + 30 * kDay);
    }
}

TEST_F(CertificateTest, oneThatIsOverIsRenewedAtTheStart) {
    make(kMade);
    CertificateKeeper keeper = this->keeper();
    EXPECT_TRUE(keeper.tend(kMade + 700 * kDay));
    EXPECT_EQ(keysOf(keeper.faults(kMade + 700 * kDay)), "");
}

TEST_F(CertificateTest, withoutTheAuthoritysKeyItIsSaidWeeksBeforeAndAnew) {
    make(kMade);
    fs::rename(files_.authorityKey, folder_ / "elsewhere");
    CertificateKeeper keeper = this->keeper();
    std::string before;
    std::string said;
    for (double day = 300; day < 400; day += 0.25) {
        EXPECT_FALSE(keeper.tend(kMade + day * kDay));
        const auto faults = keeper.faults(kMade + day * kDay);
        if (std::exchange(before, keysOf(faults)) != keysOf(faults))
            said += fmt::format("{} at {}; ", keysOf(faults), day);
        if (!faults.empty()) {
            EXPECT_NE(faults[0].text.find("authority.key: the authority's key is not there"),
                      std::string::npos)
                << faults[0].text;
        }
    }
    EXPECT_EQ(said,
              "certificate soon at 367; certificate urgent at 390; certificate over at 397.25; ");
    // Put back, it is used within the hour.
    fs::rename(folder_ / "elsewhere", files_.authorityKey);
    bool isRenewed = false;
    for (int call = 0; call < 361 && !isRenewed; ++call)
        isRenewed = keeper.tend(kMade + 400 * kDay);
    EXPECT_TRUE(isRenewed);
    EXPECT_EQ(keysOf(keeper.faults(kMade + 400 * kDay)), "");
}

// No file gets any content while it lives, as on a disk that is full.
class FullDisk {
  public:
    FullDisk() {
        signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit none{0, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &none);
    }
    ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    rlimit before_{};
};

TEST_F(CertificateTest, oneThatCannotBeWrittenOrSignedSaysWhyAndStays) {
    make(kMade);
    const std::string first = textOf(files_.certificate);
    const UnixSeconds later = kMade + 380 * kDay;
    const auto said = [&](CertificateKeeper& keeper) -> std::string {
        const auto faults = keeper.faults(later);
        EXPECT_EQ(keysOf(faults), "certificate soon");
        return faults.empty() ? "" : faults[0].text;
    };
    CertificateKeeper keeper = this->keeper();
    {
        const FullDisk full;
        EXPECT_FALSE(keeper.tend(later));
    }
    EXPECT_NE(said(keeper).find("in 17 days; it cannot be renewed: "), std::string::npos);
    EXPECT_NE(said(keeper).find("certificate.pem"), std::string::npos) << said(keeper);
    EXPECT_EQ(textOf(files_.certificate), first) << "whole, and the one that the server has";
    const std::string key = textOf(files_.authorityKey);
    std::ofstream(files_.authorityKey) << "no key";
    CertificateKeeper another = this->keeper();
    EXPECT_FALSE(another.tend(later));
    EXPECT_NE(said(another).find("is damaged"), std::string::npos) << said(another);
    // Mended, it is renewed within the hour.
    std::ofstream(files_.authorityKey) << key;
    bool isRenewed = false;
    for (int call = 0; call < 361 && !isRenewed; ++call) isRenewed = another.tend(later);
    EXPECT_TRUE(isRenewed);
    EXPECT_EQ(keysOf(another.faults(later)), "");
}

TEST_F(CertificateTest, oneThatSomebodyBroughtIsWatchedAndNeverReplaced) {
    make(kMade);
    const CertificateFiles other = certificateFilesIn(folder_ / "other");
    makeCertificate(other, {"wall.example"}, {kMade, kBuilt});
    for (const auto& [from, to] :
         {std::pair{other.certificate, files_.certificate}, std::pair{other.key, files_.key}})
        fs::copy_file(from, to, fs::copy_options::overwrite_existing);
    const std::string brought = textOf(files_.certificate);
    CertificateKeeper keeper = this->keeper();
    EXPECT_FALSE(keeper.tend(kMade + 380 * kDay));
    EXPECT_EQ(textOf(files_.certificate), brought);
    const auto faults = keeper.faults(kMade + 380 * kDay);
    ASSERT_EQ(keysOf(faults), "certificate soon");
    EXPECT_NE(faults[0].text.find("it is not of this rig's authority"), std::string::npos);
    // Put a newer one in its place: the server is to take it, and the alert is over.
    makeCertificate(other, {"wall.example"}, {kMade + 380 * kDay, kBuilt});
    fs::copy_file(other.certificate, files_.certificate, fs::copy_options::overwrite_existing);
    EXPECT_TRUE(keeper.tend(kMade + 380 * kDay));
    EXPECT_EQ(keysOf(keeper.faults(kMade + 380 * kDay)), "");
    keeper.refused("the key does not fit");
    EXPECT_EQ(keysOf(keeper.faults(kMade + 380 * kDay)), "certificate files");
    EXPECT_TRUE(keeper.tend(kMade + 380 * kDay)) << "tried again";
}

TEST_F(CertificateTest, byAClockBeforeTheBuildNothingIsMadeOrJudged) {
    try {
        make(1000);
        FAIL() << "a certificate of 1970";
    } catch (const Error& problem) {
        EXPECT_NE(std::string(problem.what()).find("1970-01-01, before this program was built"),
                  std::string::npos)
            << problem.what();
    }
    EXPECT_FALSE(fs::exists(files_.authority));
    make(kMade);
    const std::string first = textOf(files_.certificate);
    CertificateKeeper keeper = this->keeper();
    EXPECT_FALSE(keeper.tend(1000));
    EXPECT_EQ(textOf(files_.certificate), first);
    EXPECT_EQ(keysOf(keeper.faults(1000)), "");
}

TEST_F(CertificateTest, whatAClockFarAheadHasDatedIsMadeAnew) {
    make(kMade);
    const std::string authority = textOf(files_.authority);
    CertificateKeeper keeper = this->keeper();
    EXPECT_TRUE(keeper.tend(kMade + 2000 * kDay)) << "renewed by a clock that is ahead";
    keeper.taken();
    EXPECT_TRUE(keeper.tend(kMade + 5 * kDay)) << "and again by the right one";
    EXPECT_LT(keeper.validity().from, kMade + 5 * kDay);
    // An authority of the future serves nobody: --certify makes another.
    make(kMade + 2000 * kDay, true);
    EXPECT_NE(textOf(files_.authority), authority);
    EXPECT_TRUE(make(kMade).isNewAuthority);
}

TEST_F(CertificateTest, anAuthorityIsAnnouncedThreeMonthsBeforeItsEndAndNothingOutlivesIt) {
    EXPECT_TRUE(make(kMade).isNewAuthority);
    const UnixSeconds end = validityOf(files_.authority).until;
    const MadeCertificate late = make(end - 95 * kDay);
    EXPECT_FALSE(late.isNewAuthority) << "tablets know it still";
    EXPECT_NEAR(late.until, end, 1);
    CertificateKeeper keeper = this->keeper();
    EXPECT_EQ(keysOf(keeper.faults(end - 91 * kDay)), "");
    EXPECT_EQ(keysOf(keeper.faults(end - 89 * kDay)), "authority soon");
    for (double day = 89; day > -10; --day)
        EXPECT_FALSE(keeper.tend(end - day * kDay)) << "it can give no more";
    EXPECT_EQ(keysOf(keeper.faults(end - 6 * kDay)), "certificate urgent, authority urgent");
    EXPECT_EQ(keysOf(keeper.faults(end + kDay)), "certificate over, authority over");
    EXPECT_TRUE(make(end + kDay).isNewAuthority);
    EXPECT_TRUE(make(end + 2 * kDay, true).isNewAuthority);
}

}  // namespace
}  // namespace aquarama::console
