#include "shodo/status.h"

#include "base/interrupted.h"

namespace shodo {

Status::Status() : code(StatusCode::kDone), line(0), column(0), bytes_needed(0), file{}, message{} {}

Status interrupted() {
  Status status;
  status.code = StatusCode::kInterrupted;
  return status;
}

}  // namespace shodo
