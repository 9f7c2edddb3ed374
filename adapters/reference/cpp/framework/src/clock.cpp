#include "clock.hpp"

#include <chrono>

namespace lwucm {

void NodeClock::get_local_time(ucm_timeval_t& local_time) {
    using std::chrono::duration_cast;
    const auto since_begin = clock_ == Options::Clock::calendar
                                 ? duration_cast<std::chrono::microseconds>(
                                       std::chrono::system_clock::now().time_since_epoch())
                                 : duration_cast<std::chrono::microseconds>(
                                       std::chrono::steady_clock::now().time_since_epoch());
    const std::int64_t microseconds = since_begin.count();
    local_time.utv_sec = static_cast<std::uint32_t>(microseconds / 1000000);
    local_time.utv_usec = static_cast<std::int32_t>(microseconds % 1000000);
}

}  // namespace lwucm
