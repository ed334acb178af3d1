// SPDX-License-Identifier: Apache-2.0
// Avahi's implementation of multicast DNS within this process, with its objects owned; included by
// the sources of this folder only. No daemon is needed; one may run.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <avahi-common/strlst.h>
#include <avahi-common/thread-watch.h>
#include <avahi-core/core.h>
#include <avahi-core/lookup.h>
#include <avahi-core/publish.h>

namespace aquarama::enrol {

inline constexpr const char* kServiceType = "_aquarama-node._tcp";

// Calls Avahi's function for an object where it is no longer used.
template <auto function>
struct Free {
    // `object` is not null.
    template <class Object>
    void operator()(Object* object) const {
        function(object);
    }
};
using StringList = std::unique_ptr<AvahiStringList, Free<avahi_string_list_free>>;
using EntryGroup = std::unique_ptr<AvahiSEntryGroup, Free<avahi_s_entry_group_free>>;
using ServiceBrowser = std::unique_ptr<AvahiSServiceBrowser, Free<avahi_s_service_browser_free>>;

// A stack of multicast DNS and its thread, which calls back. It publishes nothing by itself.
class MdnsStack {
  public:
    // Hears of each state of the server.
    using OnState = std::function<void(AvahiServer*, AvahiServerState)>;
    // `onState` is called on the thread, and within this function. Throws Error where the machine
    // has no multicast.
    explicit MdnsStack(OnState onState);
    // No callback runs afterwards.
    ~MdnsStack();
    MdnsStack(const MdnsStack&) = delete;
    MdnsStack& operator=(const MdnsStack&) = delete;

    void start();  // of the thread, once whatever calls back is made
    void stop();   // of it: no callback runs afterwards
    // For Avahi's functions; owned by this.
    [[nodiscard]] AvahiServer* server() const { return server_.get(); }
    // Does it between two callbacks. From any other thread.
    template <class Do>
    void between(Do&& act) const {
        avahi_threaded_poll_lock(poll_.get());
        std::forward<Do>(act)();
        avahi_threaded_poll_unlock(poll_.get());
    }

  private:
    OnState onState_;
    bool isRunning_ = false;
    std::unique_ptr<AvahiThreadedPoll, Free<avahi_threaded_poll_free>> poll_;
    std::unique_ptr<AvahiServer, Free<avahi_server_free>> server_;
};

// An address of this machine on one of its networks.
struct OwnAddress {
    int interface = 0;  // its number
    std::string address;
    friend bool operator==(const OwnAddress&, const OwnAddress&) = default;
};
// As ownAddresses(), with the interfaces.
[[nodiscard]] std::vector<OwnAddress> addressesByInterface();

}  // namespace aquarama::enrol
