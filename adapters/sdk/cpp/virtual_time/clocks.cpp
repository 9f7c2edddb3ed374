// Clocks and sleeps, in virtual time.
#include <errno.h>
#include <sched.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "real.hpp"
#include "virtual_time.hpp"

namespace time_of = ucm_cts::virtual_time;
using time_of::Nanoseconds;
using time_of::process_time;
using time_of::SECOND;

namespace {

time_of::Real<int()> real_sched_yield("sched_yield");

Nanoseconds calendar() {
    Nanoseconds ahead = 0;
    time_of::is_virtual(CLOCK_REALTIME, ahead);
    return process_time.read() + ahead;
}

timespec in_timespec(Nanoseconds moment) {
    timespec time;
    time.tv_sec = moment / SECOND;
    time.tv_nsec = moment % SECOND;
    return time;
}

void sleep_for(Nanoseconds duration) {
    const Nanoseconds now = process_time.read();
    process_time.sleep_until(time_of::after(now, duration));
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept {
    Nanoseconds ahead = 0;
    if (!time_of::is_virtual(clock, ahead)) {
        return time_of::real_clock_gettime(clock, time);
    }
    *time = in_timespec(process_time.read() + ahead);
    return 0;
}

int timespec_get(timespec* time, int base) noexcept {
    if (base != TIME_UTC) {
        return 0;
    }
    *time = in_timespec(calendar());
    return base;
}

int gettimeofday(timeval* time, void* zone) noexcept {
    const Nanoseconds now = calendar();
    time->tv_sec = now / SECOND;
    time->tv_usec = now % SECOND / 1000;
    if (zone != nullptr) {
        *static_cast<struct timezone*>(zone) = {};
    }
    return 0;
}

time_t time(time_t* result) noexcept {
    const time_t now = calendar() / SECOND;
    if (result != nullptr) {
        *result = now;
    }
    return now;
}

int nanosleep(const timespec* duration, timespec* left) {
    if (duration->tv_sec < 0 || !time_of::is_time(*duration)) {
        errno = EINVAL;
        return -1;
    }
    sleep_for(time_of::in_nanoseconds(*duration));
    if (left != nullptr) {
        *left = in_timespec(0);
    }
    return 0;
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* moment, timespec* left) {
    Nanoseconds ahead = 0;
    if (!time_of::is_virtual(clock, ahead)) {
        return time_of::real_clock_nanosleep(clock, flags, moment, left);
    }
    if (moment->tv_sec < 0 || !time_of::is_time(*moment)) {
        return EINVAL;
    }
    if ((flags & TIMER_ABSTIME) != 0) {
        process_time.read();
        process_time.sleep_until(time_of::on_monotonic_clock(clock, *moment));
    } else {
        sleep_for(time_of::in_nanoseconds(*moment));
    }
    return 0;
}

unsigned sleep(unsigned seconds) {
    sleep_for(seconds * SECOND);
    return 0;
}

int usleep(useconds_t microseconds) {
    sleep_for(microseconds * Nanoseconds(1000));
    return 0;
}

int sched_yield() noexcept {
    process_time.pass(time_of::ACQUIRING);
    return real_sched_yield();
}

}  // extern "C"
