// Where a runtime comes from.
#ifndef LWUCM_RUNTIME_HPP
#define LWUCM_RUNTIME_HPP

#include <memory>
#include <string>
#include <vector>

#include "lwucm/container.hpp"
#include "lwucm/container_services.hpp"
#include "lwucm/errors.hpp"
#include "lwucm/links.hpp"
#include "lwucm/options.hpp"
#include "lwucm/repository.hpp"
#include "lwucm/timers.hpp"

namespace lwucm {

/// The root container, and what a runtime offers beside containers.
class Runtime : public virtual ContainerManager {
  public:
    /// A connection without ends. BAD_PARAMETER if there is no such connector, or it does not go with the interface.
    virtual std::shared_ptr<Link> create_link(const std::string& connector, const InterfacePtr& interface) = 0;

    /// A connection without ends with a connector of 10.4. BAD_PARAMETER if there is none for such types.
    virtual std::shared_ptr<Link> create_link(const std::string& connector, const BoundTypes& types) = 0;

    /// All records of the trace (10.1.4.2) so far, oldest first.
    virtual std::vector<LogRecord> trace_records() = 0;
};

/// The name of the product.
const char* product();

/// A new, empty, independent runtime that can instantiate what `repository` holds now.
std::shared_ptr<Runtime> create_runtime(const Repository& repository, const Options& options = Options());

}  // namespace lwucm

#endif
