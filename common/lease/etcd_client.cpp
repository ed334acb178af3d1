// SPDX-License-Identifier: Apache-2.0
#include "common/lease/etcd_client.h"

#include <utility>

#include <curl/curl.h>

#include "common/base/log.h"

namespace aquarama::lease {

namespace {

// No answer that is expected is larger than some hundred bytes.
constexpr std::size_t kMostAnswerBytes = std::size_t{64} << 10U;

// Of libcurl: fewer bytes than were given end the transfer.
std::size_t takeBytes(char* bytes, std::size_t size, std::size_t count, void* into) {
    auto& answer = *static_cast<std::string*>(into);
    if (answer.size() + size * count > kMostAnswerBytes) return 0;
    answer.append(bytes, size * count);
    return size * count;
}

void begin() {
    static const CURLcode begun = curl_global_init(CURL_GLOBAL_DEFAULT);
    if (begun != CURLE_OK) throw Error("libcurl does not begin: too little memory");
}

}  // namespace

// A handle of libcurl, which keeps its connections open.
class EtcdClient::Connection {
  public:
    explicit Connection(const Members& members) {
        begin();
        curl_ = curl_easy_init();
        headers_ = curl_slist_append(nullptr, "Content-Type: application/json");
        if (curl_ == nullptr || headers_ == nullptr) throw Error("too little memory for libcurl");
        const auto patience = static_cast<long>(members.patience.count());
        curl_easy_setopt(curl_, CURLOPT_TIMEOUT_MS, patience);
        curl_easy_setopt(curl_, CURLOPT_CONNECTTIMEOUT_MS, patience);
        curl_easy_setopt(curl_, CURLOPT_NOSIGNAL, 1L);
        curl_easy_setopt(curl_, CURLOPT_PROXY, "");  // of the environment: none
        curl_easy_setopt(curl_, CURLOPT_PROTOCOLS_STR, "http,https");
        curl_easy_setopt(curl_, CURLOPT_HTTPHEADER, headers_);
        curl_easy_setopt(curl_, CURLOPT_WRITEFUNCTION, takeBytes);
        if (members.certificates) show(*members.certificates);
    }
    ~Connection() {
        curl_slist_free_all(headers_);
        curl_easy_cleanup(curl_);
    }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    // Throws Error where nobody answers, or with another status than 200.
    std::string post(const std::string& url, const std::string& body) {
        std::string answer;
        curl_easy_setopt(curl_, CURLOPT_URL, url.c_str());
        curl_easy_setopt(curl_, CURLOPT_POSTFIELDSIZE, static_cast<long>(body.size()));
        curl_easy_setopt(curl_, CURLOPT_POSTFIELDS, body.c_str());
        curl_easy_setopt(curl_, CURLOPT_WRITEDATA, &answer);
        const CURLcode result = curl_easy_perform(curl_);
        if (result != CURLE_OK) throw Error(url + ": " + curl_easy_strerror(result));
        long status = 0;
        curl_easy_getinfo(curl_, CURLINFO_RESPONSE_CODE, &status);
        if (status != 200) throw Error(url + ": answers with status " + std::to_string(status));
        return answer;
    }

  private:
    void show(const Certificates& certificates) {
        curl_easy_setopt(curl_, CURLOPT_CAINFO, certificates.authority.c_str());
        curl_easy_setopt(curl_, CURLOPT_SSLCERT, certificates.own.c_str());
        curl_easy_setopt(curl_, CURLOPT_SSLKEY, certificates.ownKey.c_str());
    }

    CURL* curl_ = nullptr;
    curl_slist* headers_ = nullptr;
};

EtcdClient::EtcdClient(Members members)
    : members_{std::move(members)}, connection_{std::make_unique<Connection>(members_)} {}

EtcdClient::~EtcdClient() = default;

std::string EtcdClient::ask(const std::string& path, const std::string& body) {
    std::string problems;
    for (std::size_t i = 0; i < members_.urls.size(); ++i) {
        const std::size_t member = (at_ + i) % members_.urls.size();
        try {
            std::string answer = connection_->post(members_.urls[member] + "/v3/" + path, body);
            at_ = member;
            return answer;
        } catch (const Error& problem) {
            problems += (problems.empty() ? "" : "; ") + std::string(problem.what());
        }
    }
    throw Error(problems);
}

LeaseAnswer EtcdClient::grant(int seconds) {
    return grantAnswer(ask("lease/grant", grantRequest(seconds)));
}

int EtcdClient::keepAlive(std::int64_t lease) {
    return keepAliveAnswer(ask("lease/keepalive", leaseRequest(lease))).seconds;
}

void EtcdClient::revoke(std::int64_t lease) {
    ask("lease/revoke", leaseRequest(lease));
}

std::optional<LeaseHolder> EtcdClient::holder(const LeaseKeys& keys) {
    return holderAnswer(ask("kv/range", holderRequest(keys)));
}

Taken EtcdClient::take(const LeaseKeys& keys,
                       const std::string& name,
                       std::int64_t lease,
                       std::uint64_t last) {
    return takeAnswer(ask("kv/txn", takeRequest(keys, name, lease, last)));
}

}  // namespace aquarama::lease
