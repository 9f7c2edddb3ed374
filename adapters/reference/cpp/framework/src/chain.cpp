#include "chain.hpp"

namespace lwucm {

namespace {

thread_local Chain::Id joined = nullptr;
thread_local int awaited = 0;

}  // namespace

Chain::Id Chain::current() { return joined != nullptr ? joined : &joined; }

Chain::Joined::Joined(Id chain) : before_(joined) { joined = chain; }

Chain::Joined::~Joined() { joined = before_; }

Awaited::Awaited() { ++awaited; }

Awaited::~Awaited() { --awaited; }

bool Awaited::now() { return awaited > 0; }

}  // namespace lwucm
