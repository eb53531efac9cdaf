#include "shodo/status.h"

namespace shodo {

Status::Status() : code(StatusCode::kDone), line(0), column(0), bytes_needed(0), file{}, message{} {}

}  // namespace shodo
