// SPDX-License-Identifier: Apache-2.0
#include "drawings/confine.h"

#include <cerrno>
#include <memory>
#include <string>
#include <system_error>

#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::drawings {

namespace {

[[noreturn]] void fail(const char* what, int error) {
    throw Error(std::string("pictures of strangers cannot be read safely: ") + what + " (" +
                std::generic_category().message(error) +
                "); use a kernel with seccomp, and let this program limit itself");
}

void limit(__rlimit_resource what, rlim_t most) {
    const rlimit both{most, most};
    if (setrlimit(what, &both) != 0) fail("a limit is refused", errno);
}

// Rules of the kernel's filter. The first failure stays.
class Filter {
  public:
    // All else kills. Of the thread, as a service's own filter may deny the question whether a
    // whole process can be killed; this one has one thread.
    Filter() : context_{seccomp_init(SCMP_ACT_KILL_THREAD), seccomp_release} {
        if (!context_) error_ = EINVAL;
    }
    template <class... Conditions>
    void allow(int call, Conditions... conditions) {
        add(SCMP_ACT_ALLOW, call, conditions...);
    }
    // Libraries may try it, and go on without.
    void refuse(int call) { add(SCMP_ACT_ERRNO(EPERM), call); }
    void load() {
        if (error_ == 0) error_ = -seccomp_load(context_.get());
        if (error_ != 0) fail("the filter of system calls is refused", error_);
    }

  private:
    template <class... Conditions>
    void add(std::uint32_t action, int call, Conditions... conditions) {
        if (error_ == 0)
            error_ = -seccomp_rule_add(
                context_.get(), action, call, sizeof...(conditions), conditions...);
    }
    std::unique_ptr<void, void (*)(scmp_filter_ctx)> context_;
    int error_ = 0;
};

void filterCalls() {
    Filter filter;
    filter.allow(SCMP_SYS(read), SCMP_A0(SCMP_CMP_EQ, STDIN_FILENO));
    filter.allow(SCMP_SYS(write), SCMP_A0(SCMP_CMP_EQ, STDOUT_FILENO));
    filter.allow(SCMP_SYS(mmap), SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0));
    for (const int call : {SCMP_SYS(munmap),
                           SCMP_SYS(mremap),
                           SCMP_SYS(madvise),
                           SCMP_SYS(brk),
                           SCMP_SYS(futex),
                           SCMP_SYS(clock_gettime),
                           SCMP_SYS(gettimeofday),
                           SCMP_SYS(sysinfo),
                           SCMP_SYS(rt_sigreturn),
                           SCMP_SYS(exit),
                           SCMP_SYS(exit_group)})
        filter.allow(call);
    for (const int call : {SCMP_SYS(fstat), SCMP_SYS(newfstatat)}) filter.refuse(call);
    filter.load();
}

}  // namespace

void confine() {
    if (kIsSanitized) return;
    constexpr rlim_t kMostAddresses = 1'500'000'000, kMostSeconds = 20;
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_AS, kMostAddresses);
    limit(RLIMIT_CPU, kMostSeconds);
    if (prctl(PR_SET_DUMPABLE, 0) != 0) fail("it can be traced", errno);
    filterCalls();
}

}  // namespace aquarama::drawings
