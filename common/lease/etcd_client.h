// SPDX-License-Identifier: Apache-2.0
// A client of etcd: leases, and one key that lives as long as its lease.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/lease/etcd_json.h"

namespace aquarama::lease {

// Files by which this machine and etcd know each other, past the loopback.
struct Certificates {
    std::filesystem::path authority;    // of etcd's certificates
    std::filesystem::path own, ownKey;  // this machine's certificate, and its private key
};

// Where etcd is.
struct Members {
    std::vector<std::string> urls;  // "http://127.0.0.1:2379"; any one of them answers for all
    std::optional<Certificates> certificates = {};  // for https
    // So long a member may take to answer.
    std::chrono::milliseconds patience{250};
};

// Used by one thread. Every function asks the member that answered last, then the others in turn,
// and throws Error where none answers as it should.
class EtcdClient {
  public:
    explicit EtcdClient(Members members);
    ~EtcdClient();
    EtcdClient(const EtcdClient&) = delete;
    EtcdClient& operator=(const EtcdClient&) = delete;

    // etcd may grant a longer life than was asked for.
    [[nodiscard]] LeaseAnswer grant(int seconds);
    // The seconds that the lease lives on from now; 0: it has expired.
    [[nodiscard]] int keepAlive(std::int64_t lease);
    void revoke(std::int64_t lease);  // with all keys under it
    [[nodiscard]] std::optional<LeaseHolder> holder(const LeaseKeys& keys);
    [[nodiscard]] Taken take(const LeaseKeys& keys,
                             const std::string& name,
                             std::int64_t lease,
                             std::uint64_t last);

  private:
    class Connection;
    // The body of the answer.
    std::string ask(const std::string& path, const std::string& body);

    Members members_;
    std::size_t at_ = 0;  // the member that answered last
    std::unique_ptr<Connection> connection_;
};

}  // namespace aquarama::lease
