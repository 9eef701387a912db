-- Posts the file that BODY names; without BODY the request is a GET.
local name = os.getenv("BODY")
if name ~= "" then
  local file = assert(io.open(name, "rb"))
  wrk.method = "POST"
  wrk.body = file:read("*a")
  wrk.headers["Content-Type"] = "application/octet-stream"
  file:close()
end
