"""A parameter of another node, by its service; needs rclpy."""

from __future__ import annotations

from typing import Any

from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter


class RemoteParameter:
    """A text parameter of another node."""

    def __init__(self, node: Any, other: str, name: str) -> None:
        """Name the node that asks, the other node, and the parameter."""
        self._client = node.create_client(SetParameters, f"{other}/set_parameters")
        self._name = name

    def is_there(self) -> bool:
        """Return whether the node can be reached."""
        return bool(self._client.service_is_ready())

    def set(self, value: str) -> Any:
        """Ask for another value."""
        request = SetParameters.Request()
        request.parameters = [Parameter(self._name, value=value).to_parameter_msg()]
        return self._client.call_async(request)

    def refusal(self, answer: Any) -> str:
        """Return why the node did not take a value, or "" if it did."""
        try:
            result = answer.result().results[0]
        except Exception as error:  # of the middleware, such as a node that has gone meanwhile
            return str(error) or type(error).__name__
        return "" if result.successful else str(result.reason) or "it gives no reason"
