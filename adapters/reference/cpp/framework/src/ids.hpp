// Ids: numbers for components and for connections, each kind for itself.
#ifndef LWUCM_SRC_IDS_HPP
#define LWUCM_SRC_IDS_HPP

#include <cstdint>
#include <limits>
#include <random>
#include <set>

#include "lwucm/options.hpp"

namespace lwucm {

/// Counting and random ids are never used twice, reused ones as soon as they are free.
class Ids {
  public:
    explicit Ids(Options::Ids kind) : kind_(kind) {}

    std::int32_t next() {
        std::int32_t id = 0;
        if (kind_ == Options::Ids::counting) {
            return ++last_;
        }
        do {
            id = kind_ == Options::Ids::random ? any() : id + 1;
        } while (!taken_.insert(id).second);
        return id;
    }

    void release(std::int32_t id) {
        if (kind_ == Options::Ids::reused) {
            taken_.erase(id);
        }
    }

  private:
    std::int32_t any() {
        std::uniform_int_distribution<std::int32_t> all(std::numeric_limits<std::int32_t>::min());
        return all(random_);
    }

    const Options::Ids kind_;
    std::int32_t last_ = 0;
    std::set<std::int32_t> taken_;
    std::minstd_rand random_{std::random_device()()};
};

}  // namespace lwucm

#endif
