#!/usr/bin/env bash
# take-over-mirror.sh FOLDER: writes into FOLDER (the etc/apt of another system) how apt reaches the mirror here:
# proxies, certificates, passwords, and how old a list may be. No other setting: most belong to packages that the other
# system lacks, and dpkg asks about a file that it finds where a package brings its own.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: packaging/take-over-mirror.sh FOLDER" >&2; exit 2; }
folder=$1
mkdir -p "$folder/apt.conf.d" "$folder/auth.conf.d"

taken='(http|https)::|Check-Valid-Until |Check-Date |M(ax|in)-ValidTime|ForceIPv[46] |Retries '
settings=$(apt-config dump | grep -E "^Acquire::($taken)" || true)

# A program that finds the proxy is not in the other system: what it finds here is written instead. apt keeps to the
# environment where no proxy is set, and commands in the other system have an environment of their own.
proxy_of() {
    local found
    found=$(sed -n "s/^Acquire::$1::Proxy \"\(.*\)\";/\1/p" <<<"$settings")
    if [ -z "$found" ] && grep -q "^Acquire::https\?::Proxy-Auto-\?Detect \"." <<<"$settings"; then
        found=$(/usr/lib/apt/apt-helper auto-detect-proxy "$1://deb.debian.org/debian" |
            sed -n "s/^Using proxy '\(.*\)' for URL.*/\1/p")
    fi
    local variable=$1_proxy
    echo "${found:-${!variable:-}}"
}

{
    grep -Ev '::Proxy(-Auto-?Detect)? ' <<<"$settings" || true
    for protocol in http https; do
        proxy=$(proxy_of "$protocol")
        [ -z "$proxy" ] || echo "Acquire::$protocol::Proxy \"$proxy\";"
    done
    grep -E '::Proxy::[^ ]' <<<"$settings" || true  # of one host
} | sort -u >"$folder/apt.conf.d/99mirror"

# Certificates and keys that a setting names, where it says they are: FOLDER is two levels below the other system's
# root.
sed -nE 's/^Acquire::https::(.*::)?(CaInfo|CAInfo|SslCert|SslKey|IssuerCert|CrlFile) "(\/.*)";/\3/p' \
    "$folder/apt.conf.d/99mirror" |
    while IFS= read -r file; do
        [ ! -f "$file" ] || { mkdir -p "$folder/../..$(dirname "$file")" && cp "$file" "$folder/../..$file"; }
    done

# Passwords of mirrors.
for file in /etc/apt/auth.conf /etc/apt/auth.conf.d/*.conf; do
    [ ! -f "$file" ] || cp "$file" "$folder${file#/etc/apt}"
done
