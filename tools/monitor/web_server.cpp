#include "tools/monitor/web_server.hpp"

#include <fcntl.h>
#include <libwebsockets.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <stdexcept>
#include <string_view>

#include "platform/log.hpp"
#include "tools/monitor/listening_socket.hpp"
#include "tools/monitor/page_request.hpp"

namespace plumb {

static_assert(Packet::kRoom >= LWS_PRE);

/// A page. It belongs to the server's thread.
struct WebServer::Client {
  lws* socket = nullptr;
  bool greeted = false;
  NewsCursor cursor;
  std::int64_t wanted = -1;  ///< frame of a log that it asked for; -1: none
  std::int64_t newest = -1;  ///< id of the newest packet that it was sent
  int in_flight = 0;
};

struct WebServer::Shared {
  MonitorSource* source = nullptr;
  std::vector<WebFile> files;
  lws_context* context = nullptr;
  lws_vhost* host = nullptr;
  int listening_fd = -1;
  std::array<Client, kMaxPages> clients;
  int num_connections = 0;
  std::atomic<bool> stopping = false;
  std::mutex mutex;
  std::shared_ptr<const Packet> newest;  ///< guarded by the mutex
};

namespace {

constexpr std::size_t kChunkBytes = 16 * 1024;
constexpr int kNoPage = -1;

/// What lws keeps for a connection of each protocol.
struct FileSession {
  const WebFile* file;
  std::size_t sent;
};
struct PageSession {
  int slot;
};

std::string header_of(lws* socket, lws_token_indexes token) {
  std::array<char, 256> text{};
  const int length = lws_hdr_copy(socket, text.data(), static_cast<int>(text.size()), token);
  return length > 0 ? std::string(text.data(), static_cast<std::size_t>(length)) : std::string();
}

/// Whether the request comes from the page itself, or from a program that is no browser.
bool is_trusted(lws* socket) {
  const std::string host = header_of(socket, WSI_TOKEN_HOST);
  const std::string origin = header_of(socket, WSI_TOKEN_ORIGIN);
  return is_own_host(host) && (origin.empty() || origin == "http://" + host);
}

int refuse(lws* socket, unsigned int status) {
  lws_return_http_status(socket, status, nullptr);
  return -1;
}

}  // namespace

/// The callbacks of libwebsockets, all in the server's thread.
struct WebCallbacks {
  using Shared = WebServer::Shared;
  using Client = WebServer::Client;

  static WebServer* server_of(lws* socket) {
    return static_cast<WebServer*>(lws_context_user(lws_get_context(socket)));
  }

  static int send_head(lws* socket, const WebFile& file, FileSession* session) {
    std::array<std::uint8_t, LWS_PRE + 2048> head;
    std::uint8_t* const start = head.data() + LWS_PRE;
    std::uint8_t* at = start;
    std::uint8_t* const end = head.data() + head.size() - 1;
    const auto add = [&](const char* name, std::string_view value) {
      return lws_add_http_header_by_name(socket, reinterpret_cast<const std::uint8_t*>(name),
                                         reinterpret_cast<const std::uint8_t*>(value.data()),
                                         static_cast<int>(value.size()), &at, end) == 0;
    };
    const bool fits =
        lws_add_http_common_headers(socket, HTTP_STATUS_OK, file.type.c_str(), file.bytes.size(),
                                    &at, end) == 0 &&
        add("content-security-policy:",
            "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
            "img-src 'self' blob: data:; connect-src 'self'; frame-ancestors 'none'; "
            "base-uri 'none'; form-action 'none'") &&
        add("x-content-type-options:", "nosniff") && add("cache-control:", "no-cache") &&
        lws_finalize_write_http_header(socket, start, &at, end) == 0;
    if (!fits) return -1;
    *session = {&file, 0};
    lws_callback_on_writable(socket);
    return 0;
  }

  static int on_request(lws* socket, FileSession* session, std::string_view path) {
    WebServer* server = server_of(socket);
    session->file = nullptr;
    if (!is_trusted(socket)) return refuse(socket, HTTP_STATUS_FORBIDDEN);
    if (lws_hdr_total_length(socket, WSI_TOKEN_GET_URI) <= 0)
      return refuse(socket, HTTP_STATUS_METHOD_NOT_ALLOWED);
    for (const WebFile& file : server->shared_->files)
      if (path == file.path) return send_head(socket, file, session);
    return refuse(socket, HTTP_STATUS_NOT_FOUND);
  }

  static int on_file_writable(lws* socket, FileSession* session) {
    if (session == nullptr || session->file == nullptr) return -1;
    const auto rest = session->file->bytes.subspan(session->sent);
    const std::size_t count = std::min(rest.size(), kChunkBytes);
    const bool is_last = count == rest.size();
    std::vector<std::uint8_t> chunk(LWS_PRE + count);
    std::copy_n(rest.begin(), count, chunk.begin() + LWS_PRE);
    if (lws_write(socket, chunk.data() + LWS_PRE, count,
                  is_last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP) < static_cast<int>(count)) {
      return -1;
    }
    session->sent += count;
    if (!is_last) return lws_callback_on_writable(socket) < 0 ? -1 : 0;
    session->file = nullptr;
    return lws_http_transaction_completed(socket) != 0 ? -1 : 0;
  }

  static void accept_connections(WebServer* server) {
    Shared& shared = *server->shared_;
    for (;;) {
      const int fd = ::accept4(shared.listening_fd, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (fd < 0) return;
      if (shared.num_connections >= WebServer::kMaxConnections) {
        ::close(fd);
        ++server->num_refused_;
        continue;
      }
      if (lws_adopt_socket_vhost(shared.host, fd) != nullptr) ++shared.num_connections;
    }
  }

  static void wake_pages(WebServer* server) {
    for (Client& client : server->shared_->clients)
      if (client.socket != nullptr) lws_callback_on_writable(client.socket);
  }

  /// Requests of files, and the listening socket.
  static int on_file(lws* socket, lws_callback_reasons reason, void* user, void* in,
                     std::size_t length) {
    auto* session = static_cast<FileSession*>(user);
    switch (reason) {
      case LWS_CALLBACK_RAW_RX_FILE:
        accept_connections(server_of(socket));
        return 0;
      case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
        wake_pages(server_of(socket));
        return 0;
      case LWS_CALLBACK_WSI_DESTROY:
        if (lws_get_socket_fd(socket) != server_of(socket)->shared_->listening_fd)
          --server_of(socket)->shared_->num_connections;
        return 0;
      case LWS_CALLBACK_HTTP:
        return on_request(socket, session, {static_cast<const char*>(in), length});
      case LWS_CALLBACK_HTTP_WRITEABLE:
        return on_file_writable(socket, session);
      case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
        return -1;  // a WebSocket without the page's protocol
      default:
        return 0;
    }
  }

  static int open_page(lws* socket, PageSession* session) {
    WebServer* server = server_of(socket);
    session->slot = kNoPage;
    for (int i = 0; i < WebServer::kMaxPages; ++i) {
      Client& client = server->shared_->clients[static_cast<std::size_t>(i)];
      if (client.socket != nullptr) continue;
      client = Client{};
      client.socket = socket;
      session->slot = i;
      ++server->num_pages_;
      lws_callback_on_writable(socket);
      return 0;
    }
    ++server->num_refused_;
    lws_close_reason(socket, LWS_CLOSE_STATUS_POLICY_VIOLATION, nullptr, 0);
    return -1;
  }

  static int send(Client* client, const std::shared_ptr<const Packet>& packet) {
    // lws_write() writes the head of the frame into the room in front of the message. All pages are
    // served by this thread, so that none sees the head of another.
    auto* bytes = const_cast<std::uint8_t*>(packet->bytes.data()) + Packet::kRoom;
    if (lws_write(client->socket, bytes, packet->size(), LWS_WRITE_BINARY) < 0) return -1;
    if (packet->id >= 0) ++client->in_flight;
    lws_callback_on_writable(client->socket);  // there may be more
    return 0;
  }

  static int on_page_writable(WebServer* server, Client* client) {
    Shared& shared = *server->shared_;
    if (!client->greeted) {
      client->greeted = true;
      return send(client, make_packet(shared.source->hello()));
    }
    if (auto news = shared.source->news(&client->cursor)) return send(client, news);
    if (client->in_flight >= WebServer::kMaxInFlight) return 0;
    if (client->wanted >= 0) {
      auto packet = shared.source->frame(std::exchange(client->wanted, -1));
      return packet != nullptr ? send(client, packet) : 0;
    }
    std::shared_ptr<const Packet> newest;
    {
      const std::lock_guard lock(shared.mutex);
      newest = shared.newest;
    }
    if (newest == nullptr || newest->id == client->newest) return 0;
    client->newest = newest->id;
    return send(client, newest);
  }

  static int on_page_request(WebServer* server, Client* client, std::string_view text) {
    const PageRequest request = read_page_request(text);
    if (request.kind == PageRequest::Kind::kNone) return -1;
    lws_validity_confirmed(client->socket);
    if (request.kind == PageRequest::Kind::kFrame) client->wanted = request.number;
    if (request.kind == PageRequest::Kind::kAcknowledge) {
      client->in_flight = std::max(client->in_flight - 1, 0);
      server->shared_->source->acknowledge(request.number);
    }
    lws_callback_on_writable(client->socket);
    return 0;
  }

  /// The messages of the page.
  static int on_page(lws* socket, lws_callback_reasons reason, void* user, void* in,
                     std::size_t length) {
    auto* session = static_cast<PageSession*>(user);
    if (reason == LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION) return is_trusted(socket) ? 0 : -1;
    if (reason == LWS_CALLBACK_ESTABLISHED) return open_page(socket, session);
    if (session == nullptr || session->slot == kNoPage) return 0;
    WebServer* server = server_of(socket);
    Client& client = server->shared_->clients[static_cast<std::size_t>(session->slot)];
    if (client.socket != socket) return 0;
    if (reason == LWS_CALLBACK_SERVER_WRITEABLE) return on_page_writable(server, &client);
    if (reason == LWS_CALLBACK_CLOSED) {
      client.socket = nullptr;
      --server->num_pages_;
    }
    if (reason != LWS_CALLBACK_RECEIVE) return 0;
    const bool is_whole = lws_is_first_fragment(socket) != 0 && lws_is_final_fragment(socket) != 0;
    if (!is_whole || length > WebServer::kMaxRequestBytes) return -1;
    return on_page_request(server, &client, {static_cast<const char*>(in), length});
  }

  static void run(WebServer* server) {
    while (!server->shared_->stopping) {
      if (lws_service(server->shared_->context, 0) < 0) return;
    }
  }
};

namespace {

constexpr std::array<lws_protocols, 3> kProtocols = {
    lws_protocols{"file", WebCallbacks::on_file, sizeof(FileSession), 1024, 0, nullptr, 0},
    lws_protocols{"plumb-monitor", WebCallbacks::on_page, sizeof(PageSession), 1024, 0, nullptr, 0},
    lws_protocols{nullptr, nullptr, 0, 0, 0, nullptr, 0}};

/// A page that has said nothing for a minute, not even to a ping, is gone.
constexpr std::uint16_t kPing_s = 20;
constexpr std::uint16_t kHangUp_s = 60;

lws_retry_bo_t* liveness() {
  static lws_retry_bo_t policy = [] {
    lws_retry_bo_t p{};
    p.secs_since_valid_ping = kPing_s;
    p.secs_since_valid_hangup = kHangUp_s;
    return p;
  }();
  return &policy;
}

}  // namespace

WebServer::WebServer(const WebAddress& address, std::vector<WebFile> files, MonitorSource* source)
    : shared_(std::make_unique<Shared>()) {
  Shared& shared = *shared_;
  shared.source = source;
  shared.files = std::move(files);
  shared.listening_fd =
      address.listening_fd >= 0 ? address.listening_fd : listen_on(address.host, address.port);
  port_ = listening_port(shared.listening_fd);
  ::fcntl(shared.listening_fd, F_SETFL, O_NONBLOCK);  // another program may have opened it
  lws_set_log_level(LLL_ERR, [](int, const char* line) {
    log_limited("web server: %s", std::string(line).substr(0, 160).c_str());
  });
  lws_context_creation_info info{};
  info.port = CONTEXT_PORT_NO_LISTEN_SERVER;
  info.protocols = kProtocols.data();
  info.user = this;
  info.gid = static_cast<gid_t>(-1);
  info.uid = static_cast<uid_t>(-1);
  info.timeout_secs = 10;
  info.keepalive_timeout = 10;
  info.retry_and_idle_policy = liveness();
  info.options = LWS_SERVER_OPTION_DISABLE_IPV6 | LWS_SERVER_OPTION_EXPLICIT_VHOSTS;
  shared.context = lws_create_context(&info);
  if (shared.context != nullptr) shared.host = lws_create_vhost(shared.context, &info);
  lws_sock_file_fd_type listening{};
  listening.filefd = shared.listening_fd;
  if (shared.host == nullptr || lws_adopt_descriptor_vhost(shared.host, LWS_ADOPT_RAW_FILE_DESC,
                                                           listening, "file", nullptr) == nullptr) {
    throw std::runtime_error("the web server cannot be started");
  }
  thread_ = std::thread(WebCallbacks::run, this);
}

WebServer::~WebServer() {
  shared_->stopping = true;
  lws_cancel_service(shared_->context);
  thread_.join();
  lws_context_destroy(shared_->context);
}

void WebServer::publish(std::shared_ptr<const Packet> packet) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->newest = std::move(packet);
  }
  notify();
}

void WebServer::notify() { lws_cancel_service(shared_->context); }

}  // namespace plumb
