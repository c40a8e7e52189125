# Sets up this computer to run plans. It runs as root, and can run again for an upgrade.
set -eu
cd "$(dirname "$0")"

# The user that runs plans, with access to serial ports, pins and buses.
if ! id afp >/dev/null 2>&1; then
    useradd --create-home --shell /bin/bash --password '*' afp
fi
for group in dialout gpio i2c spi; do
    if getent group "$group" >/dev/null; then usermod -aG "$group" afp; fi
done

# The keys that log in to this account also log in as afp.
home=$(getent passwd afp | cut -d: -f6)
keys=$(getent passwd "${SUDO_USER:-root}" | cut -d: -f6)/.ssh/authorized_keys
install -d -m 700 -o afp -g afp "$home/.ssh"
if [ -f "$keys" ]; then
    touch "$home/.ssh/authorized_keys"
    sort -u "$keys" "$home/.ssh/authorized_keys" >keys
    install -m 600 -o afp -g afp keys "$home/.ssh/authorized_keys"
fi

# The folder of the releases, and the description of the robot.
install -d -m 755 -o afp -g afp /var/lib/afp
for file in afp.toml calibration.toml; do
    if [ -f "$file" ]; then install -m 644 -o afp -g afp "$file" /var/lib/afp; fi
done

# The program. A program that does not run here replaces nothing.
install -m 755 afpc /usr/local/bin/afpc.new
/usr/local/bin/afpc.new --version
if [ -e /etc/systemd/system/afp.service ]; then systemctl stop afp; fi
mv /usr/local/bin/afpc.new /usr/local/bin/afpc

# The access point starts at the next boot, because it would end this connection.
if [ -f access-point ]; then
    { read -r name && read -r password; } <access-point
    nmcli connection delete afp-access-point >/dev/null 2>&1 || true
    nmcli connection add type wifi con-name afp-access-point ifname wlan0 ssid "$name" \
        autoconnect yes connection.autoconnect-priority 100 \
        802-11-wireless.mode ap 802-11-wireless.band bg ipv4.method shared \
        wifi-sec.key-mgmt wpa-psk wifi-sec.psk "$password"
fi

# The names of devices, and the service.
install -D -m 644 99-afp.rules /etc/udev/rules.d/99-afp.rules
udevadm control --reload && udevadm trigger --subsystem-match=tty || true
/usr/local/bin/afpc agent --unit >/etc/systemd/system/afp.service
systemctl daemon-reload
systemctl enable afp
systemctl restart afp
