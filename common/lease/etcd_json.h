// SPDX-License-Identifier: Apache-2.0
// What is said to etcd and what it answers, as text: API v3 as JSON, with keys and values in
// base64 and numbers of 64 bits as strings. An answer may be anything: what is not as it should be
// is an Error.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace aquarama::lease {

// Who holds a key.
struct LeaseHolder {
    std::string name;            // the value of the key, printable
    std::int64_t lease = 0;      // under which it was put
    std::uint64_t revision = 0;  // of its put
};

// The keys of a show: `holder` exists while its lease lives, `last` for ever: it has the revision
// of the last one who took the former.
struct LeaseKeys {
    std::string holder, last;
};

// The result of an attempt to take a key.
struct Taken {
    std::optional<std::uint64_t> revision;  // of the put; nothing: it was not taken
    std::optional<LeaseHolder> holder;      // who has it then, if anybody
};

// Bodies of requests. `seconds`: the time to live of a lease.
[[nodiscard]] std::string grantRequest(int seconds);
[[nodiscard]] std::string leaseRequest(std::int64_t lease);  // to keep it alive, or revoke it
[[nodiscard]] std::string holderRequest(const LeaseKeys& keys);
// Takes the key where nobody holds it, and nobody but `last`, a revision, has held it before; 0:
// whoever has.
[[nodiscard]] std::string takeRequest(const LeaseKeys& keys,
                                      const std::string& name,
                                      std::int64_t lease,
                                      std::uint64_t last);

// Answers. All throw Error, which says what is wrong with them. A lease's: its number, and the
// seconds that it lives on, 0 where it has expired.
struct LeaseAnswer {
    std::int64_t lease = 0;
    int seconds = 0;
};
[[nodiscard]] LeaseAnswer grantAnswer(const std::string& body);
[[nodiscard]] LeaseAnswer keepAliveAnswer(const std::string& body);
[[nodiscard]] std::optional<LeaseHolder> holderAnswer(const std::string& body);
[[nodiscard]] Taken takeAnswer(const std::string& body);

}  // namespace aquarama::lease
