// Chain: calls that lead from one to the next, whichever threads carry them out.
#ifndef LWUCM_SRC_CHAIN_HPP
#define LWUCM_SRC_CHAIN_HPP

namespace lwucm {

/// A thread that carries out a call for another one, which waits for it, acts in the chain of that one meanwhile.
class Chain {
  public:
    typedef const void* Id;

    /// The chain in which the calling thread acts; never null.
    static Id current();

    /// Scope in which the calling thread acts in another chain.
    class Joined {
      public:
        explicit Joined(Id chain);
        ~Joined();
        Joined(const Joined&) = delete;
        Joined& operator=(const Joined&) = delete;

      private:
        const Id before_;
    };
};

/// Scope in which the calling thread executes components for somebody whom an operation of a container may have to wait
/// for: no such operation can be carried out inside.
class Awaited {
  public:
    Awaited();
    ~Awaited();
    Awaited(const Awaited&) = delete;
    Awaited& operator=(const Awaited&) = delete;

    /// Is the calling thread in such a scope?
    static bool now();
};

}  // namespace lwucm

#endif
