// Chain: calls that lead from one to the next, whichever threads carry them out.
#ifndef LWUCM_SRC_CHAIN_HPP
#define LWUCM_SRC_CHAIN_HPP

namespace lwucm {

/// A thread that carries out a call for another one, which waits for it, belongs to the chain of that one meanwhile.
class Chain {
  public:
    typedef const void* Id;

    /// The chain to which the calling thread belongs; never null.
    static Id current() { return joined() != nullptr ? joined() : &joined(); }

    /// Scope in which the calling thread belongs to another chain.
    class Joined {
      public:
        explicit Joined(Id chain) : before_(joined()) { joined() = chain; }
        ~Joined() { joined() = before_; }
        Joined(const Joined&) = delete;
        Joined& operator=(const Joined&) = delete;

      private:
        const Id before_;
    };

  private:
    static Id& joined() {
        static thread_local Id chain = nullptr;
        return chain;
    }
};

/// Scope in which the calling thread executes components for a caller whom an operation of a container may have to wait
/// for: no such operation can be carried out inside.
class Awaited {
  public:
    Awaited() { ++depth(); }
    ~Awaited() { --depth(); }
    Awaited(const Awaited&) = delete;
    Awaited& operator=(const Awaited&) = delete;

    /// Is the calling thread in such a scope?
    static bool now() { return depth() > 0; }

  private:
    static int& depth() {
        static thread_local int scopes = 0;
        return scopes;
    }
};

}  // namespace lwucm

#endif
