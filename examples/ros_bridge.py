"""Lets a planner in ROS 2 fly in gnbv. It is a command that speaks the view exchange:

    gnbv run aircraft --utility route --views '|python3 ros_bridge.py' --out runs/ros
    gnbv bench run --track exact --planner "python3 ros_bridge.py" --name mine -o mine

After each view it publishes what was measured, and waits for the next view:

    ~/camera/NAME/depth   sensor_msgs/Image, 32FC1, metres; with ~/camera/NAME/info and .../pose
    ~/pose                geometry_msgs/PoseStamped of the body, world ENU, as estimated
    ~/answer              std_msgs/String: the line of the exchange as it is (budget left, bounds)
    ~/next_view           geometry_msgs/PoseStamped, from the planner: the body's next pose
    ~/end                 std_msgs/Empty, from the planner: no more views

A view that is refused is told by ~/answer alone. Nothing of gnbv is imported.
"""

import json
import math
import sys

import numpy as np
import rclpy
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import Empty, String


class Bridge:
    def __init__(self, node):
        self.node = node
        self.publishers = {}
        self.task = {}  # of each camera, by name
        self.next_view = None  # (x, y, z, yaw in degrees)
        self.is_over = False
        node.create_subscription(PoseStamped, "~/next_view", self.on_next_view, 1)
        node.create_subscription(Empty, "~/end", self.on_end, 1)

    def on_next_view(self, told):
        p, q = told.pose.position, told.pose.orientation
        yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
        self.next_view = (p.x, p.y, p.z, math.degrees(yaw))

    def on_end(self, _):
        self.is_over = True

    def publish(self, kind, topic, message):
        if topic not in self.publishers:
            self.publishers[topic] = self.node.create_publisher(kind, topic, 1)
        self.publishers[topic].publish(message)

    def stamped(self, message, time_s, frame):
        message.header.stamp.sec = int(time_s)
        message.header.stamp.nanosec = int(1e9 * (time_s % 1.0))
        message.header.frame_id = frame
        return message

    def pose(self, told, time_s):
        message = self.stamped(PoseStamped(), time_s, "world")
        p, q = message.pose.position, message.pose.orientation
        p.x, p.y, p.z = told["position_m"]
        q.x, q.y, q.z, q.w = told["qx_qy_qz_qw"]
        return message

    def publish_camera(self, told, time_s):
        name, known = told["name"], self.task[told["name"]]
        width, height = known["width_px"], known["height_px"]
        frame = f"{name}_optical"
        image = self.stamped(Image(), time_s, frame)
        image.width, image.height, image.step = width, height, 4 * width
        image.encoding, image.is_bigendian = "32FC1", 0
        depth = np.fromfile(told["depth_f32"], "<f4", width * height)
        image.data = depth.tobytes()
        info = self.stamped(CameraInfo(), time_s, frame)
        info.width, info.height = width, height
        fx, fy, cx, cy = (known[key] for key in ("fx_px", "fy_px", "cx_px", "cy_px"))
        info.k = [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]
        self.publish(Image, f"~/camera/{name}/depth", image)
        self.publish(CameraInfo, f"~/camera/{name}/info", info)
        self.publish(PoseStamped, f"~/camera/{name}/pose", self.pose(told, time_s))

    def tell(self, line):
        """What became of the last view; whether the mission goes on."""
        told = json.loads(line)
        if told["event"] == "start":
            self.task = {camera["name"]: camera for camera in told["task"]["cameras"]}
        if told["event"] in ("start", "flown"):
            for camera in told["cameras"]:
                self.publish_camera(camera, told["time_s"])
            self.publish(PoseStamped, "~/pose", self.pose(told, told["time_s"]))
        answer = String()
        answer.data = line
        self.publish(String, "~/answer", answer)  # last: all else is there
        return told["event"] != "end"

    def run(self):
        print("x,y,z,yaw_deg", flush=True)
        while (line := sys.stdin.readline()) and self.tell(line.rstrip("\n")):
            while rclpy.ok() and not self.is_over and self.next_view is None:
                rclpy.spin_once(self.node, timeout_sec=0.1)
            if self.next_view is None:
                return  # the end of our output ends the mission
            print(",".join(repr(float(x)) for x in self.next_view), flush=True)
            self.next_view = None


def main():
    rclpy.init()
    Bridge(rclpy.create_node("gnbv")).run()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
